// SPDX-License-Identifier: MIT
#include "common/second_order/study.hpp"

#include "common/compare/splatting.hpp"

namespace nephroid::examples::second_order {

namespace {

/// Photon differential splatting, its smoothing no longer to be found.
[[nodiscard]] Method with_smoothing_fixed() {
    Method method = *find_method("splat");
    method.id = "splat-fixed";
    return method;
}

/// The pictures are not looked at again, and a study has many.
[[nodiscard]] Trial without_pictures(Trial trial) {
    for (Best& best : trial.best)
        best.irradiance = {};
    return trial;
}

/// At one bandwidth, not the best.
[[nodiscard]] Trial at_bandwidth(const Bench& bench, const Method& method, const Photons& photons, double bandwidth) {
    Trial trial;
    trial.method = &method;
    trial.sequence = photons.sequence;
    trial.wanted = photons.wanted;
    trial.caustic = photons.deposits.size();
    trial.emitted = photons.emitted;
    const Estimate estimate = method.run(bench, photons, bandwidth, Source::stored);
    Best best;
    best.method = &method;
    best.bandwidth = bandwidth;
    best.errors = bench.errors(estimate.irradiance);
    best.timing.seconds = estimate.seconds;
    trial.best.fill(best);
    return trial;
}

} // namespace

std::vector<Study> study(const Options& options, const std::function<void(const Trial&)>& done) {
    static const Method fixed = with_smoothing_fixed();
    std::vector<Study> studies;
    for (const std::string& name : options.cases) {
        CompareOptions each = options.each;
        each.scene = name;
        const Bench bench(each);
        for (const SequenceKind sequence : each.sequences) {
            Study result{name, sequence, {}, {}, {}};
            for (const std::uint64_t wanted : each.photons) {
                const Photons photons = bench.trace(sequence, wanted);
                const auto keep = [&](std::vector<Trial>& trials, Trial trial) {
                    trials.push_back(without_pictures(std::move(trial)));
                    done(trials.back());
                };
                keep(result.best, tried(each, bench, *find_method("splat"), photons));
                keep(result.fixed, at_bandwidth(bench, fixed, photons, options.fixed_smoothing));
                keep(result.second, tried(each, bench, *find_method("splat-auto"), photons));
            }
            studies.push_back(std::move(result));
        }
    }
    return studies;
}

std::vector<const Trial*> pointers(const std::vector<Trial>& trials) {
    std::vector<const Trial*> result;
    for (const Trial& trial : trials)
        result.push_back(&trial);
    return result;
}

double ratio(const Study& study, std::size_t count, Measure measure) {
    return study.second[count].cost(measure) / study.best[count].cost(measure);
}

} // namespace nephroid::examples::second_order
