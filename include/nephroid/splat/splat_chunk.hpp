// SPDX-License-Identifier: MIT
/// @file  A part of a batch's splats, and the leaves of the eye path map that each of them overlaps.
#pragma once

#include "nephroid/splat/splat_reach.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// Selects all leaves of the map's tree.
struct EveryLeaf {
    [[nodiscard]] constexpr bool operator()(std::uint32_t) const { return true; }
};

/// A splat and a leaf that it overlaps, by their indices.
struct LeafVisit {
    std::uint32_t leaf, splat;
    LeafMeeting meeting;
};

/// Splats of one kind made by one thread, in the order of their photons. Aligned, because threads fill neighbouring
/// chunks at the same time.
///
/// @tparam S  for_each_reached_leaf(map, splat, takes, visit) calls visit(leaf, meeting) for each leaf that it overlaps
///            and for which takes(leaf) is true
template <class S>
class alignas(64) ChunkOf {
public:
    /// Adds a splat if it overlaps a leaf that has vertices which may lie inside it and face it.
    ///
    /// @param takes  takes(leaf) returns whether a leaf of the map's tree is to receive light
    /// @return  whether the splat was added
    template <Vector3 V, class Takes = EveryLeaf>
    bool add(const EyePathMap<V>& map, const S& splat, const Takes& takes = {}) {
        const std::size_t before = visits_.size();
        const auto number = std::uint32_t(splats_.size());
        for_each_reached_leaf(map, splat, takes, [&](std::uint32_t leaf, const LeafMeeting& meeting) {
            visits_.push_back({leaf, number, meeting});
        });
        if (visits_.size() == before)
            return false;
        splats_.push_back(splat);
        return true;
    }

    void clear() {
        splats_.clear();
        visits_.clear();
    }

    [[nodiscard]] const std::vector<S>& splats() const { return splats_; }
    [[nodiscard]] const std::vector<LeafVisit>& visits() const { return visits_; }

private:
    std::vector<S> splats_;
    std::vector<LeafVisit> visits_;
};

template <Vector3 V, Flux F>
using SplatChunk = ChunkOf<Splat<V, F>>;

} // namespace nephroid::detail
