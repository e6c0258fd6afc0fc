// SPDX-License-Identifier: MIT
#include "common/study/relax/timing.hpp"

#include "common/memory.hpp"
#include "common/stopwatch.hpp"
#include "common/study/relax/subject.hpp"
#include "common/text.hpp"

#include "nephroid/relaxation/relax.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

namespace nephroid::examples::study::relax {

namespace {

/// Seconds for all photons: by the clock, and of the processors.
struct Cost {
    double wall = std::numeric_limits<double>::infinity();
    double processor = std::numeric_limits<double>::infinity();
};

[[nodiscard]] std::vector<StoredPhoton> random_photons(const Options& options) {
    std::vector<StoredPhoton> photons;
    photons.reserve(options.photons);
    const Color flux(1 / static_cast<float>(options.photons));
    const RandomSequence sequence(options.seed);
    for (std::uint64_t i = 0; i < options.photons; ++i)
        photons.push_back(
            {{sequence.sample<float>(i, 0), sequence.sample<float>(i, 1), 0}, {0, 0, 1}, {0, 0, -1}, flux});
    return photons;
}

class Timer {
public:
    Timer(const Options& options, ThreadExecutor& threads)
        : options_(&options), threads_(&threads), photons_(random_photons(options)) {
        (void)cost_of(1, true, false); // so that no part pays for the first touch of memory
    }

    [[nodiscard]] double photons() const { return static_cast<double>(photons_.size()); }

    /// The least cost of a few runs.
    [[nodiscard]] Cost cost_of(unsigned iterations, bool features, bool pilot) {
        RelaxationOptions relaxation = options_->relaxation;
        relaxation.iterations = iterations;
        relaxation.constrain = features;
        relaxation.pilot_neighbours = pilot ? (std::max)(150u, relaxation.pilot_neighbours) : 0;
        const auto access = photon_access(&StoredPhoton::position, &StoredPhoton::normal, &StoredPhoton::flux);
        Cost least;
        for (double spent = 0, tries = 0; tries < 7 && (tries < 2 || spent < 4); ++tries) {
            std::vector<StoredPhoton> photons = photons_;
            const MemoryPeak peak;
            Stopwatch stopwatch;
            const std::clock_t start = std::clock();
            (void)nephroid::relax(photons, access, relaxation, *threads_);
            const double processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            const double wall = stopwatch.lap();
            bytes_ = (std::max)(bytes_, peak.bytes().value_or(0));
            spent += wall;
            least = {(std::min)(least.wall, wall), (std::min)(least.processor, processor)};
        }
        return least;
    }

    /// The least cost of finding all photons' neighbours, as an iteration does.
    [[nodiscard]] Cost cost_of_neighbours(std::size_t count) {
        using Cloud = nephroid::detail::PhotonCloud<glm::vec3, Color>;
        const auto access = photon_access(&StoredPhoton::position, &StoredPhoton::normal, &StoredPhoton::flux);
        const Cloud cloud(photons_, access, options_->relaxation.cos_same_surface, "study relax --timing");
        std::vector<float> radius(cloud.tree().slots()); // found the first time, and guessed right from then on
        Cost least;
        for (int tries = 0; tries < 5; ++tries) {
            Stopwatch stopwatch;
            const std::clock_t start = std::clock();
            nephroid::detail::for_each_leaf<nephroid::detail::Neighbourhood<Cloud>>(
                cloud.tree(), *threads_, [&](auto& neighbourhood, std::uint32_t leaf) {
                    neighbourhood.for_each(cloud, leaf, count, radius, [&](std::size_t slot, auto found) {
                        radius[slot] = found.empty() ? 0 : std::sqrt(found.back().distance2);
                    });
                });
            least.processor = (std::min)(least.processor, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
            least.wall = (std::min)(least.wall, stopwatch.lap());
        }
        return least;
    }

    /// The most memory that a run has taken; 0 where the system does not tell.
    [[nodiscard]] double bytes() const { return bytes_; }

private:
    const Options* options_;
    ThreadExecutor* threads_;
    std::vector<StoredPhoton> photons_;
    double bytes_ = 0;
};

} // namespace

Table cost_table(const Options& options, ThreadExecutor& threads) {
    constexpr unsigned iterations = 5;
    Timer timer(options, threads);
    Table table{"cost",
                "Cost of relaxing " + grouped(options.photons) + " random photons",
                text("%u thread%s, K = %u; microseconds per photon", threads.threads(),
                     threads.threads() == 1 ? "" : "s", options.relaxation.neighbours),
                {"part", "wall", "processor"},
                {}};
    const double scale = 1e6 / timer.photons();
    const auto line = [&](const char* part, const Cost& with, const Cost& without, double times) {
        table.rows.push_back({part, text("%.3f", scale * (with.wall - without.wall) / times),
                              text("%.3f", scale * (with.processor - without.processor) / times)});
    };
    const bool pilot = options.relaxation.pilot_neighbours > 0;
    const Cost cloud = timer.cost_of(0, false, false);
    line("copy and tree", cloud, {0, 0}, 1);
    line("feature search", timer.cost_of(0, true, false), cloud, 1);
    const Cost piloted = timer.cost_of(0, false, true);
    line("pilot densities", piloted, cloud, 1);
    line("one iteration", timer.cost_of(iterations, false, pilot), pilot ? piloted : cloud, iterations);
    line("of it, neighbours", timer.cost_of_neighbours((pilot ? 2 : 1) * (options.relaxation.neighbours + 1)), {0, 0},
         1);
    (void)timer.cost_of(1, true, pilot);
    if (timer.bytes() > 0)
        table.caption += text("; %.0f bytes of memory per photon at its peak, besides the caller's photons",
                              timer.bytes() / timer.photons());
    return table;
}

} // namespace nephroid::examples::study::relax
