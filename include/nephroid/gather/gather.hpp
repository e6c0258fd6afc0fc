// SPDX-License-Identifier: MIT
/// @file  What the estimators that gather stored photons have in common.
#pragma once

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/gather/photon_map.hpp"

#include <cmath>

namespace nephroid {

namespace detail {
/// Room for neighbours, one per thread and scalar type: it grows to the largest look-up and stays, so that a look-up
/// needs neither a lock nor an allocation.
template <Scalar T>
[[nodiscard]] std::span<Neighbour<T>> neighbours(std::size_t count) {
    thread_local std::vector<Neighbour<T>> scratch;
    if (scratch.size() < count)
        scratch.resize(count);
    return {scratch.data(), count};
}

/// Diffuse surfaces: their response does not depend on where light comes from, and is the caller's to multiply with.
struct NoResponse {};

/// How far above the tangent plane of a place (relative to the tree's origin) a photon lies.
template <Vector3 V, Flux F>
[[nodiscard]] scalar_t<V> height(const PhotonMap<V, F>& map, std::size_t slot, const V& relative_place,
                                 const V& normal) {
    const PointTree<V>& tree = map.tree();
    return dot(V(make_vector<V>(tree.x()[slot], tree.y()[slot], tree.z()[slot]) - relative_place), normal);
}

/// Adds a photon's share to a sum.
template <Vector3 V, Flux F, class Response>
void receive(F& sum, const PhotonMap<V, F>& map, std::size_t slot, scalar_t<V> weight, const Response& response) {
    if constexpr (std::same_as<Response, NoResponse>)
        sum = sum + map.flux(slot) * weight;
    else
        sum = sum + map.flux(slot) * weight * response(map.direction(slot));
}

/// A length option: positive, and finite unless infinity means that there is no bound.
inline void check_length(const char* who, const char* name, double length, bool may_be_infinite) {
    if (!(length > 0) || (!may_be_infinite && !std::isfinite(length)))
        invalid_argument(std::string(who) + ": " + name + " is " + text_of(length) + "; it must be positive" +
                         (may_be_infinite ? "" : " and finite"));
}

/// Calls use(slot, squared distance) for every photon nearer to a place than a radius and on the side that a normal
/// points to, in leaf order.
template <Vector3 V, Flux F, class Use>
void for_each_within(const PhotonMap<V, F>& map, const V& position, const V& normal, scalar_t<V> radius, Use&& use) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    constexpr std::size_t lanes = PointTree<V>::lanes;
    const PointTree<V>& tree = map.tree();
    const V relative = tree.relative(position);
    const std::array<T, 3> p = {t::x(relative), t::y(relative), t::z(relative)};
    const Box<T> box{{p[0] - radius, p[1] - radius, p[2] - radius}, {p[0] + radius, p[1] + radius, p[2] + radius}};
    const T radius2 = radius * radius;
    tree.visit_leaves(box, [&](std::uint32_t number) {
        const TreeLeaf leaf = tree.leaves()[number];
        std::array<T, lanes> distance2;
        for (std::size_t first = leaf.first; first < leaf.first + leaf.size; first += lanes) {
            tree.distances2(first, p, distance2);
            const std::size_t count = (std::min)(lanes, leaf.first + leaf.size - first);
            for (std::size_t i = 0; i < count; ++i)
                if (distance2[i] < radius2 && map.faces(first + i, normal))
                    use(first + i, distance2[i]);
        }
    });
}
} // namespace detail

} // namespace nephroid
