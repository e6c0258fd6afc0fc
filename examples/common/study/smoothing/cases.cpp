// SPDX-License-Identifier: MIT
#include "common/study/smoothing/cases.hpp"

#include "common/command_line.hpp"
#include "common/study/bench.hpp"

namespace nephroid::examples::study::smoothing {

namespace {

/// Photon differential splatting, its smoothing no longer to be found.
[[nodiscard]] Method with_smoothing_fixed() {
    Method method = *find_method("splat");
    method.id = "splat-fixed";
    return method;
}

/// The pictures are not looked at again, and there are many.
[[nodiscard]] Trial without_pictures(Trial trial) {
    for (Best& best : trial.best)
        best.irradiance = {};
    return trial;
}

} // namespace

void check_references(const Options& options) {
    if (options.each.reference)
        return;
    for (const std::string& name : options.cases)
        if (!has_exact_picture(name))
            throw UsageError("--reference: the exact picture of " + name + " is not known; give a .pfm");
}

std::vector<Case> measure_cases(const Options& options, const std::function<void(const Trial&)>& done) {
    static const Method fixed = with_smoothing_fixed();
    std::vector<Case> cases;
    for (const std::string& name : options.cases) {
        study::Options each = options.each;
        each.scene = name;
        const Bench bench(each);
        for (const SequenceKind sequence : each.sequences) {
            Case result{name, sequence, {}, {}, {}};
            for (const std::uint64_t wanted : each.photons) {
                const Photons photons = bench.trace(sequence, wanted);
                const auto keep = [&](std::vector<Trial>& trials, Trial trial) {
                    trials.push_back(without_pictures(std::move(trial)));
                    done(trials.back());
                };
                keep(result.best, tried(each, bench, *find_method("splat"), photons));
                keep(result.fixed, tried_at(bench, fixed, photons, options.fixed_smoothing));
                keep(result.second, tried(each, bench, *find_method("splat-auto"), photons));
            }
            cases.push_back(std::move(result));
        }
    }
    return cases;
}

std::vector<const Trial*> pointers(const std::vector<Trial>& trials) {
    std::vector<const Trial*> result;
    for (const Trial& trial : trials)
        result.push_back(&trial);
    return result;
}

double ratio(const Case& one, std::size_t count, Measure measure) {
    return one.second[count].cost(measure) / one.best[count].cost(measure);
}

} // namespace nephroid::examples::study::smoothing
