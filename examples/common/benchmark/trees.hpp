// SPDX-License-Identifier: MIT
/// @file  Benchmarks of the trees: building, nearest photons and relaxation, each compared with nanoflann alone.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/points.hpp"
#include "common/benchmark/table.hpp"

#include "nephroid/gather/nearest_photons.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/relaxation/relax.hpp"

namespace nephroid::examples::benchmarks {

inline void benchmark_build(const Effort& effort) {
    for (const std::size_t side : {std::size_t(512), std::size_t(1000)}) {
        const std::vector<Vertex> vertices = film_vertices(side);
        const std::vector<Vec> positions = positions_of(vertices);
        const Cloud cloud{&positions};
        const double items = double(vertices.size());
        const auto theirs = [&] {
            const Index index(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(PointTree<Vec>::leaf_size));
            benchmark::DoNotOptimize(&index);
        };
        const auto tree = [&] {
            const PointTree<Vec> ours(vertices.size(), [&](std::size_t i) { return positions[i]; });
            benchmark::DoNotOptimize(&ours);
        };
        const auto map = [&] {
            const EyePathMap<Vec> ours(vertices, &Vertex::position, &Vertex::normal);
            benchmark::DoNotOptimize(&ours);
        };
        const auto t = seconds_per_item(effort, {{items, theirs}, {items, tree}, {items, map}});
        const std::string of = " of " + std::to_string(vertices.size()) + " vertices";
        print_row("build the tree" + of, 1e9 * t[1], "ns", "nanoflann's build", t[1] / t[0]);
        print_row("build the eye path map" + of, 1e9 * t[2], "ns", "nanoflann's build", t[2] / t[0], Bar::at_most(1.3));
    }
}

/// A photon map and nanoflann over the same photons.
class StoredPhotons {
public:
    explicit StoredPhotons(std::size_t count)
        : positions_(places(count, HaltonSequence())), cloud_{&positions_},
          index_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {
        for (const Vec& at : positions_)
            deposits_.push_back({at, {0, 0, 1}, {0, 0, -1}, 1 / float(count), {}});
    }
    StoredPhotons(const StoredPhotons&) = delete;
    StoredPhotons& operator=(const StoredPhotons&) = delete;

    [[nodiscard]] const std::vector<Deposit<Vec, float, 0>>& deposits() const { return deposits_; }
    [[nodiscard]] const std::vector<Vec>& positions() const { return positions_; }

    /// nanoflann's knnSearch, its results written to what is given.
    void nearest(const Vec& at, std::vector<std::uint32_t>& indices, std::vector<float>& distances2) const {
        index_.knnSearch(&at.x, indices.size(), indices.data(), distances2.data());
    }

private:
    std::vector<Deposit<Vec, float, 0>> deposits_;
    std::vector<Vec> positions_;
    Cloud cloud_;
    Index index_;
};

/// The irradiance along a picture's rows from the k nearest photons.
inline void benchmark_nearest(const Effort& effort) {
    for (const std::size_t photons : {std::size_t(20'000), std::size_t(262'144)}) {
        const StoredPhotons stored(photons);
        const PhotonMap<Vec, float> map(stored.deposits());
        const std::vector<Vertex> vertices = film_vertices(64);
        for (const std::size_t k : {20u, 50u, 200u}) {
            const NearestPhotons<Vec, float, UniformKernel> estimate(map, {.count = k});
            std::vector<std::uint32_t> indices(k);
            std::vector<float> distances2(k);
            float sum = 0;
            const auto theirs = [&] {
                for (const Vertex& vertex : vertices) {
                    stored.nearest(vertex.position, indices, distances2);
                    float flux = 0;
                    for (std::size_t i = 0; i + 1 < k; ++i)
                        flux += stored.deposits()[indices[i]].flux;
                    sum += flux / (pi<float> * distances2.back());
                }
                benchmark::DoNotOptimize(sum);
            };
            const auto ours = [&] {
                for (const Vertex& vertex : vertices)
                    sum += estimate(vertex.position, vertex.normal);
                benchmark::DoNotOptimize(sum);
            };
            const double items = double(vertices.size());
            const auto t = seconds_per_item(effort, {{items, theirs}, {items, ours}});
            print_row("the " + std::to_string(k) + " nearest of " + std::to_string(photons) + " photons", 1e-6 / t[1],
                      "M/s", "nanoflann's knnSearch", t[0] / t[1],
                      Bar::at_least(k == 20   ? 1.2
                                    : k == 50 ? 1.4
                                              : 2));
        }
    }
}

inline void benchmark_relaxation(const Effort& effort) {
    const std::size_t photons = 50'000;
    const StoredPhotons stored(photons);
    std::vector<std::uint32_t> indices(7); // itself among them
    std::vector<float> distances2(7);
    const auto theirs = [&] {
        for (const Vec& at : stored.positions())
            stored.nearest(at, indices, distances2);
        benchmark::DoNotOptimize(indices.data());
    };
    using Photon = Deposit<Vec, float, 0>;
    SerialExecutor serial;
    const auto relaxed = [&](unsigned iterations) {
        return [&stored, &serial, iterations] {
            auto moved = stored.deposits();
            relax(moved, photon_access(&Photon::position, &Photon::normal, &Photon::flux),
                  RelaxationOptions{.iterations = iterations, .constrain = false}, serial);
            benchmark::DoNotOptimize(moved.data());
        };
    };
    // Both times include the preparation before the first iteration.
    const double items = double(photons);
    const auto t = seconds_per_item(effort, {{items, theirs}, {items, relaxed(4)}, {items, relaxed(12)}});
    const double iteration = (t[2] - t[1]) / 8;
    print_row("an iteration of relaxation, a photon of " + std::to_string(photons), 1e9 * iteration, "ns",
              "nanoflann's 6 neighbours", iteration / t[0], Bar::at_most(1.5));
}

} // namespace nephroid::examples::benchmarks
