// SPDX-License-Identifier: MIT
/// @file  Some of a batch's splats, and the leaves of the eye path map that each of them meets.
#pragma once

#include "nephroid/splat/splat_reach.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// All leaves of the map's tree take photons.
struct EveryLeaf {
    [[nodiscard]] constexpr bool operator()(std::uint32_t) const { return true; }
};

/// The splat with this number meets this leaf.
struct LeafVisit {
    std::uint32_t leaf, splat;
    LeafMeeting meeting;
};

/// Splats that one thread has made, in the order of their photons. Aligned, as threads fill neighbouring chunks at the
/// same time.
template <Vector3 V, Flux F>
class alignas(64) SplatChunk {
public:
    /// @param takes  takes(leaf) -> whether that leaf of the map's tree is to get its part
    /// @return  whether the splat meets a leaf with vertices that may lie in it and face it; else it is not kept
    template <class Takes = EveryLeaf>
    bool add(const EyePathMap<V>& map, const Splat<V, F>& splat, const Takes& takes = {}) {
        const std::size_t before = visits_.size();
        const auto number = std::uint32_t(splats_.size());
        const SplatReach<V, F> reach(splat);
        map.tree().visit_leaves(splat.box, [&](std::uint32_t leaf) {
            if (!takes(leaf))
                return;
            if (const LeafMeeting meeting = reach(map.leaf(leaf)); meeting.meets)
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

    [[nodiscard]] const std::vector<Splat<V, F>>& splats() const { return splats_; }
    [[nodiscard]] const std::vector<LeafVisit>& visits() const { return visits_; }

private:
    std::vector<Splat<V, F>> splats_;
    std::vector<LeafVisit> visits_;
};

} // namespace nephroid::detail
