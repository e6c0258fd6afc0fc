// SPDX-License-Identifier: MIT
#include "common/study/relax/before_and_after.hpp"

#include "common/stopwatch.hpp"

#include "nephroid/relaxation/detect_features.hpp"
#include "nephroid/relaxation/relax.hpp"

#include <utility>

namespace nephroid::examples::study::relax {

namespace {

[[nodiscard]] PhotonMapLooks looks_at(const Subject& subject, const std::vector<StoredPhoton>& photons,
                                      const Options& options, const std::vector<std::size_t>& neighbours, bool sweep,
                                      ThreadExecutor& threads) {
    PhotonMapLooks result;
    Stopwatch stopwatch;
    const Map map = map_of(photons);
    result.build_seconds = stopwatch.lap();
    for (const std::size_t k : neighbours)
        result.looks.push_back(look(subject, map, k, options.kernel, threads));
    if (sweep && subject.truth) {
        const BestNeighbours best = best_neighbours(subject, map, options.sweep, options.kernel, threads);
        result.best = look(subject, map, best.relative, options.kernel, threads);
        result.best_picture = look(subject, map, best.rmse, options.kernel, threads);
    }
    const auto evenly_lit = options.spectrum ? options.spectrum : subject.evenly_lit;
    if (evenly_lit && subject.floor)
        result.blue_noise = blue_noise(photons, *evenly_lit, threads);
    return result;
}

} // namespace

BeforeAndAfter before_and_after(const Subject& subject, const Options& options, ThreadExecutor& threads) {
    BeforeAndAfter result;
    result.threads = threads.threads();
    result.before = looks_at(subject, subject.photons, options, options.neighbours, true, threads);

    const auto access = photon_access(&StoredPhoton::position, &StoredPhoton::normal, &StoredPhoton::flux);
    if (options.relaxation.constrain)
        for (const auto& constraint : detect_features(subject.photons, access, options.relaxation, threads))
            result.weights.push_back(constraint.weight);
    result.relaxed = subject.photons;
    Stopwatch stopwatch;
    if (subject.project)
        result.relaxation = nephroid::relax(result.relaxed, access, options.relaxation, threads, subject.project);
    else
        result.relaxation = nephroid::relax(result.relaxed, access, options.relaxation, threads);
    result.relaxation_seconds = stopwatch.lap();

    std::vector<std::size_t> neighbours = options.neighbours;
    if (neighbours.empty())
        neighbours.push_back(result.relaxation.estimate_neighbours);
    result.after = looks_at(subject, result.relaxed, options, neighbours, false, threads);
    return result;
}

} // namespace nephroid::examples::study::relax
