// SPDX-License-Identifier: MIT
/// @file  How far the surface goes on about each eye path vertex, and so which share of a disk there lies on it.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/footprint/kernel_mass.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/receiver/surface_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

/// How free distances are found.
struct FreeDistanceOptions {
    double reach = 0;         ///< how far surfaces are followed, world units; 0 is a third of the map's diagonal
    unsigned directions = 32; ///< about each vertex: a multiple of 8, up to 256. With 8 a coverage is off by a tenth in
                              ///< corners, with 32 by a hundredth
};

/// The distances from each vertex of a map, in directions of its tangent plane, at which a wall stands or the surface
/// ends. An estimate of light from the photons in a disk divides by the disk's coverage: otherwise it is dark along all
/// edges, where a part of the disk lies beside the surface.
///
/// ```cpp
/// const nephroid::FreeDistances distances(map, scene, {}, threads);
/// nephroid::splat_global(scene, lamp, sums, distances, {.count = 20'000}, threads);
/// ```
///
/// Cost: 24 rays for a vertex with nothing near it, about 100 with walls or edges within reach. Memory: two bytes for
/// each vertex and direction.
/// include/nephroid/README.md, "Coverage", derives it.
template <detail::MustBeVector V>
class FreeDistances {
public:
    using T = scalar_t<V>;

    /// @param map       kept by reference; must outlive the distances
    /// @param scene     its `intersect` is called, from several threads; not needed after the call
    /// @param executor  who runs the work; the distances do not depend on it
    /// Throws std::invalid_argument for a reach that is negative or not finite and directions that are not a multiple
    /// of 8 from 8 to 256.
    template <class S, class E = SerialExecutor>
        requires RayTracer<S, V> && ExecutorArgument<E>
    FreeDistances(const EyePathMap<V>& map, const S& scene, const FreeDistanceOptions& options = {}, E&& executor = E{})
        : map_(&map), directions_(checked_directions(options)), reach_(checked_reach(options, map)),
          by_slot_(map.tree().slots() * directions_), nearest_(map.tree().slots(), reach_) {
        if (!(reach_ > T(0))) // no vertices, or all in one place
            return;
        std::vector<std::uint64_t> rays(map.tree().leaves().size());
        executor(rays.size(), [&](std::size_t leaf) { rays[leaf] = probe_leaf(scene, map.tree().leaves()[leaf]); });
        for (const std::uint64_t of_leaf : rays)
            rays_ += of_leaf;
    }
    template <class S, class... Others>
    FreeDistances(const EyePathMap<V>&&, const S&, Others&&...) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    /// How far surfaces were followed, world units. Disks may be larger; what lies beyond counts as surface.
    [[nodiscard]] T reach() const { return reach_; }
    /// Rays that were traced to find the distances.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

    /// The share of a kernel's mass that lies on the surface about a vertex, in [0, 1]: the mean over the directions of
    /// its mass within the free distance.
    ///
    /// @param slot    of the vertex in the map's tree
    /// @param radius  of the disk, world units, > 0
    template <class K>
    [[nodiscard]] T coverage(std::size_t slot, T radius, const K& kernel) const {
        if (!(nearest_[slot] < radius) || !(nearest_[slot] < reach_))
            return T(1);
        const std::uint16_t* const distances = by_slot_.data() + slot * directions_;
        const T scale = reach_ / (T(most) * radius);
        T sum(0);
        for (std::size_t i = 0; i < directions_; ++i)
            sum = sum + (distances[i] == most ? T(1) : detail::mass_within(kernel, square(scale * T(distances[i]))));
        return sum / T(directions_);
    }

    /// The free distance of a slot's vertex in one of the directions, world units; `reach` if it is that or more.
    [[nodiscard]] T distance(std::size_t slot, std::size_t direction) const {
        return reach_ / T(most) * T(by_slot_[slot * directions_ + direction]);
    }
    [[nodiscard]] std::size_t directions() const { return directions_; }

private:
    static constexpr std::uint16_t most = 0xffff; ///< stands for `reach`: distances are stored as multiples of it

    [[nodiscard]] static std::size_t checked_directions(const FreeDistanceOptions& options) {
        if (options.directions < 8 || options.directions > 256 || options.directions % 8 != 0)
            invalid_argument("nephroid::FreeDistances: directions is " + std::to_string(options.directions) +
                             "; it must be a multiple of 8, from 8 to 256");
        return options.directions;
    }
    [[nodiscard]] static T checked_reach(const FreeDistanceOptions& options, const EyePathMap<V>& map) {
        if (!(options.reach >= 0) || !std::isfinite(options.reach))
            invalid_argument("nephroid::FreeDistances: reach is " + detail::text_of(options.reach) +
                             "; it must be positive and finite, or 0 for a third of the map's diagonal");
        return options.reach > 0 ? T(options.reach) : map.diagonal() / T(3);
    }

    /// @return  the number of rays
    template <class S>
    std::uint64_t probe_leaf(const S& scene, const TreeLeaf& leaf) {
        detail::SurfaceProbe<S, V> probe(scene, reach_);
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
            probe_vertex(probe, slot);
        return probe.rays();
    }

    /// Eight directions first: where they meet nothing, the others are not asked.
    template <class Probe>
    void probe_vertex(Probe& probe, std::size_t slot) {
        const PointTree<V>& tree = map_->tree();
        const V normal = make_vector<V>(map_->normal_x()[slot], map_->normal_y()[slot], map_->normal_z()[slot]);
        const V position = tree.origin() + make_vector<V>(tree.x()[slot], tree.y()[slot], tree.z()[slot]);
        const Frame<V> frame = frame_about(normal);
        std::uint16_t* const distances = by_slot_.data() + slot * directions_;
        const std::size_t stride = directions_ / 8;
        const auto ask = [&](std::size_t i) {
            const T angle = T(2) * pi<T> * (T(i) + T(0.5)) / T(directions_);
            const T free = probe.free_distance(position, normal, V(cos(angle) * frame.u + sin(angle) * frame.v));
            distances[i] = free < reach_ ? std::uint16_t(double(free / reach_) * double(most) + 0.5) : most;
            nearest_[slot] = (std::min)(nearest_[slot], free);
        };
        for (std::size_t i = 0; i < directions_; i += stride)
            ask(i);
        const bool is_free = !(nearest_[slot] < reach_);
        for (std::size_t i = 0; i < directions_; ++i)
            if (is_free)
                distances[i] = most;
            else if (i % stride != 0)
                ask(i);
    }

    const EyePathMap<V>* map_;
    std::size_t directions_;
    T reach_;
    std::vector<std::uint16_t> by_slot_; ///< by slot, then direction
    std::vector<T> nearest_;             ///< by slot: the least of its distances
    std::uint64_t rays_ = 0;
};

} // namespace nephroid
