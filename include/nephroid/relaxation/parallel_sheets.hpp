// SPDX-License-Identifier: MIT
/// @file  Tells apart parallel sheets that lie closer together than their photons do, such as two panes.
#pragma once

#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/reach_guess.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace nephroid::detail {

/// How far off the tangent plane a photon's own sheet reaches, from the heights of its neighbours above that plane.
///
/// Neighbours on one surface lie at all heights between the lowest and the highest, as it bends away; those of two
/// sheets lie in two layers, with a gap that is several times as wide as the layers are thick.
///
/// @param heights     signed; the photon's own, 0, among them; sorted by this
/// @param resolution  gaps below it are rounding
/// @return  the middle of the gap; infinity if there is one sheet alone
template <Scalar T>
[[nodiscard]] T sheet_reach(std::span<T> heights, T resolution) {
    constexpr std::size_t fewest = 8; // heights that show layers
    constexpr T clear = T(4);         // of 16 neighbours on a sphere one in a million has such a gap
    if (heights.size() < fewest)
        return std::numeric_limits<T>::infinity();
    std::sort(heights.begin(), heights.end());
    std::size_t above = 1; // the gap lies below this height
    for (std::size_t i = 2; i < heights.size(); ++i)
        if (heights[i] - heights[i - 1] > heights[above] - heights[above - 1])
            above = i;
    const T gap = heights[above] - heights[above - 1];
    const T layers = (heights[above - 1] - heights.front()) + (heights.back() - heights[above]);
    if (!(gap > clear * layers) || !(gap > resolution))
        return std::numeric_limits<T>::infinity();
    return abs(T(0.5) * (heights[above] + heights[above - 1]));
}

/// Finds parallel sheets among a cloud's photons, and sets how far each photon's sheet reaches. Only two sheets are
/// told apart: three at equal distances are taken for one.
template <class Cloud, class E>
void separate_sheets(Cloud& cloud, E& executor) {
    using V = typename Cloud::vector;
    using T = typename Cloud::T;
    constexpr std::size_t neighbours = 16;
    std::vector<T> reach(cloud.tree().slots()), sheets(reach.size(), std::numeric_limits<T>::infinity());
    for (const TreeLeaf& leaf : cloud.tree().leaves())
        guess_reach(cloud.tree(), leaf, neighbours, reach);
    struct Search {
        Neighbourhood<Cloud> neighbourhood;
        std::vector<T> heights;
    };
    for_each_leaf<Search>(cloud.tree(), executor, [&](Search& search, std::uint32_t leaf) {
        search.neighbourhood.for_each(
            cloud, leaf, neighbours, reach, [&](std::size_t slot, std::span<Neighbour<T>> found) {
                if (found.empty())
                    return;
                const V position = cloud.position(slot);
                search.heights.assign(1, T(0));
                for (const Neighbour<T>& other : found)
                    search.heights.push_back(dot(V(cloud.position(other.slot) - position), cloud.normal(slot)));
                const T scale = length(position) + sqrt(found.back().distance2);
                sheets[slot] = sheet_reach<T>(search.heights, T(256) * std::numeric_limits<T>::epsilon() * scale);
            });
    });
    if (std::any_of(sheets.begin(), sheets.end(), [](const T& sheet) { return isfinite(sheet); }))
        cloud.set_sheets(std::move(sheets));
}

} // namespace nephroid::detail
