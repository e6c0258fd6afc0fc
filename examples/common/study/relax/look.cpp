// SPDX-License-Identifier: MIT
#include "common/study/relax/look.hpp"

#include "common/stopwatch.hpp"

#include "nephroid/gather/coverage.hpp"
#include "nephroid/gather/estimate_at.hpp"
#include "nephroid/gather/nearest_photons.hpp"

#include <algorithm>
#include <limits>

namespace nephroid::examples::study::relax {

namespace {

constexpr double edge_reach = 0.04; ///< half a bar of the test pattern
constexpr std::size_t edge_offsets = 81;

[[nodiscard]] std::optional<Errors> errors_of(const Subject& subject, const Image<Rgb>& picture) {
    if (!subject.truth)
        return std::nullopt;
    std::vector<float> irradiance; // the truth is grey
    irradiance.reserve(picture.pixels.size());
    for (const Rgb& pixel : picture.pixels)
        irradiance.push_back(pixel[0]);
    return errors_against(*subject.truth, irradiance, picture.width, picture.height);
}

template <class Estimate>
[[nodiscard]] double render(const Subject& subject, const Estimate& estimate, Image<Rgb>& picture,
                            ThreadExecutor& threads) {
    using Vertex = EyeVertex<float, Color>;
    std::ranges::fill(picture.pixels, Rgb{});
    Stopwatch stopwatch;
    estimate_at(subject.vertices, &Vertex::position, &Vertex::normal, estimate, threads,
                [&](std::size_t i, const Color& irradiance) {
                    const Vertex& vertex = subject.vertices[i];
                    const Color seen = irradiance * vertex.weight;
                    for (int channel = 0; channel < 3; ++channel)
                        picture.pixels[vertex.pixel][static_cast<std::size_t>(channel)] += seen[channel];
                });
    return stopwatch.lap();
}

/// Calls use(estimate) with the estimate of a kernel. On a surface that ends it is divided by the kernel's share there.
template <class Use>
auto with_estimate(const Subject& subject, const Map& map, std::size_t neighbours, LookKernel kernel, const Use& use) {
    const auto with_kernel = [&](const auto& k) {
        if (subject.on_surface)
            return use(NearestPhotons(map, {.count = neighbours}, k, SampledCoverage{subject.on_surface, k}));
        return use(NearestPhotons(map, {.count = neighbours}, k));
    };
    return kernel == LookKernel::biweight ? with_kernel(BiweightKernel{}) : with_kernel(EpanechnikovKernel{});
}

template <class Estimate>
[[nodiscard]] Look look_with(const Subject& subject, std::size_t neighbours, const Estimate& estimate,
                             ThreadExecutor& threads) {
    Look result{neighbours, std::numeric_limits<double>::infinity(), {subject.width, subject.height}, {}, {}, {}};
    for (double spent = 0, tries = 0; tries < 3 && (tries == 0 || spent < 1); ++tries) {
        const double seconds = render(subject, estimate, result.picture, threads);
        spent += seconds;
        result.seconds = (std::min)(result.seconds, seconds);
    }
    result.errors = errors_of(subject, result.picture);
    for (const Edge& edge : subject.edges) {
        const auto irradiance = [&](double x, double y) {
            const glm::vec3 position(static_cast<float>(x), static_cast<float>(y), 0);
            return static_cast<double>(estimate(position, glm::vec3(0, 0, 1)).x);
        };
        result.profiles.push_back(edge_profile(edge, edge_reach, edge_offsets, irradiance, threads));
        result.edge_widths.push_back(edge_width(edge, result.profiles.back()));
    }
    return result;
}

} // namespace

Map map_of(const std::vector<StoredPhoton>& photons) {
    return {photons, &StoredPhoton::position, &StoredPhoton::normal, &StoredPhoton::direction, &StoredPhoton::flux};
}

Look look(const Subject& subject, const Map& map, std::size_t neighbours, LookKernel kernel, ThreadExecutor& threads) {
    return with_estimate(subject, map, neighbours, kernel,
                         [&](const auto& estimate) { return look_with(subject, neighbours, estimate, threads); });
}

BestNeighbours best_neighbours(const Subject& subject, const Map& map, const std::vector<std::size_t>& neighbours,
                               LookKernel kernel, ThreadExecutor& threads) {
    constexpr int patience = 3;
    Image<Rgb> picture(subject.width, subject.height);
    BestNeighbours best{neighbours.front(), neighbours.front()};
    Errors least;
    least.relative = least.rmse = std::numeric_limits<double>::infinity();
    int worse = 0;
    for (std::size_t i = 0; i < neighbours.size() && worse < patience; ++i) {
        with_estimate(subject, map, neighbours[i], kernel,
                      [&](const auto& estimate) { return render(subject, estimate, picture, threads); });
        const auto errors = errors_of(subject, picture);
        ++worse;
        if (errors && errors->relative < least.relative) {
            least.relative = errors->relative;
            best.relative = neighbours[i];
            worse = 0;
        }
        if (errors && errors->rmse < least.rmse) {
            least.rmse = errors->rmse;
            best.rmse = neighbours[i];
            worse = 0;
        }
    }
    return best;
}

} // namespace nephroid::examples::study::relax
