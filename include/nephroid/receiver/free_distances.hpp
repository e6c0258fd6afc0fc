// SPDX-License-Identifier: MIT
/// @file  How far the surface goes on about each eye path vertex, and so which share of a disk there lies on it.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/compass.hpp"
#include "nephroid/receiver/default_reach.hpp"
#include "nephroid/receiver/distance_table.hpp"
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
    double reach = 0;         ///< how far surfaces are followed, world units; 0 is about half of a room's width, from
                              ///< the nine tenths of the vertices that are closest to their median
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
/// The map's normals must be geometric. About one that is tilted by more than 14°, as shading normals may be, the
/// surface leaves the tangent plane at once, and ends at the vertex in the directions in which it does.
///
/// Cost: 40 rays for a vertex with nothing near it, about 170 with walls or edges within reach. Memory: two bytes for
/// each vertex and direction. Steps lower than a twentieth of the reach may be overlooked.
/// include/nephroid/README.md, "Coverage", derives it.
template <detail::MustBeVector V>
class FreeDistances {
public:
    using T = scalar_t<V>;

    /// @param map       kept by reference; must outlive the distances
    /// @param scene     its `intersect` is called, from several threads; not needed after the call
    /// @param executor  who runs the work; the distances do not depend on it
    /// Throws std::invalid_argument for a reach that is negative or not finite, none where all vertices are in one
    /// place, and directions that are not a multiple of 8 from 8 to 256.
    template <RayTracer<V> S, ExecutorArgument E = SerialExecutor>
    FreeDistances(const EyePathMap<V>& map, const S& scene, const FreeDistanceOptions& options = {}, E&& executor = E{})
        : map_(&map), table_(map.tree().slots(), checked_directions(options), checked_reach(options, map)),
          nearest_in_leaf_(map.tree().leaves().size(), table_.reach()) {
        std::vector<std::uint64_t> rays(map.tree().leaves().size());
        executor(rays.size(), [&](std::size_t leaf) { rays[leaf] = probe_leaf(scene, leaf); });
        for (const std::uint64_t of_leaf : rays)
            rays_ += of_leaf;
    }
    template <class S, class... Others>
    FreeDistances(const EyePathMap<V>&&, const S&, Others&&...) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    /// How far surfaces were followed, world units. Disks may be larger; what lies beyond counts as surface.
    [[nodiscard]] T reach() const { return table_.reach(); }
    /// Rays that were traced to find the distances.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

    /// The share of a kernel's mass that lies on the surface about a vertex, in [0, 1]: on the places that the vertex
    /// `reaches`.
    ///
    /// @param slot    of the vertex in the map's tree
    /// @param radius  of the disk, world units, > 0
    template <class K>
    [[nodiscard]] T coverage(std::size_t slot, T radius, const K& kernel) const {
        return table_.coverage(slot, radius, kernel);
    }

    /// Whether a place belongs to the piece of surface about a vertex: nothing ends the surface before it. So light in
    /// the next room stays there, behind the thinnest wall.
    ///
    /// @param slot    of the vertex in the map's tree
    /// @param offset  of the place from the vertex, world units
    [[nodiscard]] bool reaches(std::size_t slot, const V& offset) const {
        using t = vector_traits<V>;
        const T distance2 = length2(offset);
        return !table_.ends_within(slot, distance2) ||
               table_.is_before_end(slot, distance2,
                                    detail::compass_point(map_->normal_x()[slot], map_->normal_y()[slot],
                                                          map_->normal_z()[slot], T(t::x(offset)), T(t::y(offset)),
                                                          T(t::z(offset))));
    }

    /// Clears the weights of the vertices of a leaf that a place does not belong to.
    ///
    /// @param x, y, z  of the place, relative to the tree's origin
    /// @param radius   of the disk about the place, beyond which all weights are zero already
    /// @param weights  one for each vertex, with room for whole lanes
    void keep_reached(std::uint32_t leaf, T x, T y, T z, T radius,
                      std::array<T, PointTree<V>::leaf_size>& weights) const {
        if (!(nearest_in_leaf_[leaf] < (std::min)(radius, reach())))
            return;
        const TreeLeaf at = map_->tree().leaves()[leaf];
        const std::size_t lanes = PointTree<V>::lanes, size = (at.size + lanes - 1) / lanes * lanes;
        const T* const px = map_->tree().x() + at.first;
        const T* const py = map_->tree().y() + at.first;
        const T* const pz = map_->tree().z() + at.first;
        const T* const nx = map_->normal_x() + at.first;
        const T* const ny = map_->normal_y() + at.first;
        const T* const nz = map_->normal_z() + at.first;
        const T* const nearest = &table_.nearest(at.first);
        std::array<T, PointTree<V>::leaf_size> distance2;
        T asks(0); // of how many vertices a surface ends before the place's distance
        for (std::size_t i = 0; i < size; ++i) {
            distance2[i] = square(x - px[i]) + square(y - py[i]) + square(z - pz[i]);
            asks = asks + keep_if(nearest[i] * nearest[i] <= distance2[i], weights[i]);
        }
        if (!(asks > T(0)))
            return;
        std::array<std::int32_t, PointTree<V>::leaf_size> point;
        for (std::size_t i = 0; i < size; ++i)
            point[i] = detail::compass_point(nx[i], ny[i], nz[i], x - px[i], y - py[i], z - pz[i]);
        for (std::size_t i = 0; i < at.size; ++i)
            if (weights[i] > T(0) && table_.ends_within(at.first + i, distance2[i]) &&
                !table_.is_before_end(at.first + i, distance2[i], point[i]))
                weights[i] = T(0);
    }

    /// The free distance of a slot's vertex in one of the directions, world units; `reach` if it is that or more.
    [[nodiscard]] T distance(std::size_t slot, std::size_t direction) const { return table_.distance(slot, direction); }
    [[nodiscard]] std::size_t directions() const { return table_.directions(); }

private:
    [[nodiscard]] static std::size_t checked_directions(const FreeDistanceOptions& options) {
        if (options.directions < 8 || options.directions > 256 || options.directions % 8 != 0)
            invalid_argument("nephroid::FreeDistances: directions is " + std::to_string(options.directions) +
                             "; it must be a multiple of 8, from 8 to 256");
        return options.directions;
    }
    [[nodiscard]] static T checked_reach(const FreeDistanceOptions& options, const EyePathMap<V>& map) {
        if (!(options.reach >= 0) || !std::isfinite(options.reach))
            invalid_argument("nephroid::FreeDistances: reach is " + detail::text_of(options.reach) +
                             "; it must be positive and finite, or 0 to follow from the map");
        const T reach = options.reach > 0 ? T(options.reach) : detail::default_reach(map);
        if (!(reach > T(0)) && !map.tree().empty())
            invalid_argument("nephroid::FreeDistances: all vertices are in one place, from which no reach follows; "
                             "give a reach");
        return reach;
    }

    [[nodiscard]] V normal_of(std::size_t slot) const {
        return make_vector<V>(map_->normal_x()[slot], map_->normal_y()[slot], map_->normal_z()[slot]);
    }

    /// @return  the number of rays
    template <class S>
    std::uint64_t probe_leaf(const S& scene, std::size_t number) {
        const T spacing = map_->leaf(std::uint32_t(number)).spacing, most_lift = reach() / T(64);
        detail::SurfaceProbe<S, V> probe(scene, reach(),
                                         spacing > T(0) ? (std::min)(most_lift, T(2) * spacing) : most_lift);
        const TreeLeaf leaf = map_->tree().leaves()[number];
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            probe_vertex(probe, slot);
            nearest_in_leaf_[number] = (std::min)(nearest_in_leaf_[number], table_.nearest(slot));
        }
        return probe.rays();
    }

    /// Eight directions first: where they meet nothing, the others are not asked.
    template <class Probe>
    void probe_vertex(Probe& probe, std::size_t slot) {
        const PointTree<V>& tree = map_->tree();
        const V normal = normal_of(slot);
        const V position = tree.origin() + make_vector<V>(tree.x()[slot], tree.y()[slot], tree.z()[slot]);
        const Frame<V> frame = frame_about(normal);
        const std::size_t stride = directions() / 8;
        const auto ask = [&](std::size_t i) {
            const T angle = T(2) * pi<T> * (T(i) + T(0.5)) / T(directions());
            table_.set(slot, i, probe.free_distance(position, normal, V(cos(angle) * frame.u + sin(angle) * frame.v)));
        };
        for (std::size_t i = 0; i < directions(); i += stride)
            ask(i);
        for (std::size_t i = 0; i < directions() && table_.nearest(slot) < reach(); ++i)
            if (i % stride != 0)
                ask(i);
    }

    const EyePathMap<V>* map_;
    detail::DistanceTable<T> table_;
    std::vector<T> nearest_in_leaf_; ///< the least distance of each leaf
    std::uint64_t rays_ = 0;
};

} // namespace nephroid
