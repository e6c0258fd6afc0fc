// SPDX-License-Identifier: MIT
/// @file  Compares splatting with a radius search that calls back, and with a loop over as many points in an array.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/points.hpp"
#include "common/benchmark/table.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/splat/splat_photons.hpp"

#include <cmath>

namespace nephroid::examples::benchmarks {

/// Policies without a pixel filter, so that every footprint is a disk with a known number of vertices.
using DiskPolicies = decltype(Published{}.with_filter(NoPixelFilter{}));
using DiskSplatter = nephroid::detail::Splatter<Vec, float, Irradiance, DiskPolicies>;

/// nanoflann's radius search, which calls this for every point within reach.
class SplatCallback {
public:
    using DistanceType = float;
    using IndexType = std::uint32_t;

    SplatCallback(std::vector<float>& sums, float radius, float peak)
        : sums_(sums.data()), radius2_(radius * radius), inverse2_(1 / radius2_), peak_(peak) {}
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] bool full() const { return true; }
    [[nodiscard]] float worstDist() const { return radius2_; }
    bool addPoint(float distance2, std::uint32_t index) {
        sums_[index] += peak_ * BiweightKernel{}(distance2 * inverse2_);
        ++count_;
        return true;
    }
    void sort() const {}

private:
    float* sums_;
    float radius2_, inverse2_, peak_;
    std::size_t count_ = 0;
};

/// The inner loop by itself: adds a splat to points in an array.
inline void splat_in_a_row(const Splat<Vec, float>& s, const float* x, const float* y, const float* z, float* sum,
                           std::size_t count) {
    const Vec c = s.centre, a = s.row_a, b = s.row_b, n = s.row_n;
    const float peak = s.peak;
    for (std::size_t i = 0; i < count; ++i) {
        const float dx = x[i] - c.x, dy = y[i] - c.y, dz = z[i] - c.z;
        const float u = a.x * dx + a.y * dy + a.z * dz, v = b.x * dx + b.y * dy + b.z * dz;
        const float off = n.x * dx + n.y * dy + n.z * dz;
        sum[i] += peak * keep_if(off * off < 1.0f, BiweightKernel{}(u * u + v * v));
    }
}

class SplatBenchmark {
public:
    /// @param side      side² vertices
    /// @param vertices  in each footprint
    SplatBenchmark(std::size_t side, std::size_t vertices)
        : vertices_(film_vertices(side)), map_(vertices_, &Vertex::position, &Vertex::normal),
          radius_(std::sqrt(float(vertices) / pi<float>) / float(side)) {
        const std::size_t photons = (std::min)(std::size_t(1) << 14, (std::size_t(1) << 22) / vertices);
        for (const Vec& at : places(photons, HaltonSequence()))
            deposits_.push_back({at, {0, 0, 1}, {0, 0, -1}, 1, {Vec(2 * radius_, 0, 0), Vec(0, 2 * radius_, 0)}});
        for (const auto& deposit : deposits_)
            splats_.push_back(make_splat(deposit, map_, DiskPolicies{}).splat.value());
    }

    void run(const Effort& effort) {
        const std::vector<Vec> positions = positions_of(vertices_);
        const Cloud cloud{&positions};
        const Index index(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
        std::vector<float> sums(vertices_.size());
        std::size_t reached = 0;
        const auto search = [&] {
            reached = 0;
            for (const auto& deposit : deposits_) {
                SplatCallback callback(sums, radius_, 1);
                index.findNeighbors(callback, &deposit.position.x, {});
                reached += callback.size();
            }
        };
        search();

        const PointTree<Vec>& tree = map_.tree();
        std::vector<float> row(tree.slots());
        const std::size_t each = reached / deposits_.size(), last = tree.slots() - each;
        const auto in_a_row = [&] {
            std::size_t at = 0;
            for (const auto& splat : splats_) {
                splat_in_a_row(splat, tree.x() + at, tree.y() + at, tree.z() + at, row.data() + at, each);
                at = at + each <= last ? (at + each) / PointTree<Vec>::lanes * PointTree<Vec>::lanes : 0;
            }
            benchmark::DoNotOptimize(row.data());
        };

        auto sums_of_splats = nephroid::sums<float>(map_);
        DiskSplatter splatter(sums_of_splats, DiskPolicies{});
        const auto from_deposits = [&] { nephroid::splat(deposits_, sums_of_splats, {}, DiskPolicies{}, serial_); };
        std::vector<DiskSplatter::Chunk> chunks(1);
        const auto ready = [&] {
            for (std::size_t i = 0; i < splats_.size();) {
                chunks[0].clear();
                const std::size_t end = (std::min)(splats_.size(), i + nephroid::detail::BatchSizes::most);
                while (i < end && chunks[0].visits().size() < nephroid::detail::BatchSizes::visits)
                    chunks[0].add(map_, splats_[i++]);
                splatter.add(std::span<const DiskSplatter::Chunk>(chunks), serial_);
            }
        };
        const double items = double(reached);
        const auto t =
            seconds_per_item(effort, {{items, search}, {items, in_a_row}, {items, ready}, {items, from_deposits}});
        const std::string what =
            "splat, " + std::to_string(vertices_.size()) + " vertices, " + std::to_string(each) + " in a footprint";
        const double bar = each < 30 ? 4 : each < 130 ? 6 : 10;
        print_row(what, 1e-6 / t[2], "M/s", "nanoflann with a callback", t[0] / t[2], Bar::at_least(bar));
        print_row(what, 1e-6 / t[2], "M/s", "a loop over a row", t[1] / t[2], each > 200 ? Bar::at_least(0.5) : Bar{});
        print_row(what + ", from deposits", 1e-6 / t[3], "M/s", "nanoflann with a callback", t[0] / t[3]);
    }

private:
    std::vector<Vertex> vertices_;
    EyePathMap<Vec> map_;
    float radius_;
    std::vector<Deposit<Vec, float>> deposits_;
    std::vector<Splat<Vec, float>> splats_;
    SerialExecutor serial_;
};

inline void benchmark_splatting(const Effort& effort) {
    for (const std::size_t side : {std::size_t(512), std::size_t(1000)})
        for (const std::size_t vertices : {10u, 64u, 256u, 1000u})
            SplatBenchmark(side, vertices).run(effort);
}

} // namespace nephroid::examples::benchmarks
