// SPDX-License-Identifier: MIT
/// @file  Whether the patches between nine photons predict well enough where light lands.
#pragma once

#include "nephroid/sheet/node_block.hpp"
#include "nephroid/sheet/receiver_pixels.hpp"
#include "nephroid/sheet/refinement.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid::detail {

/// Measures how much blocks of 2 × 2 cells need to be split.
template <Vector3 V, Flux F>
class BlockNeeds {
public:
    using T = scalar_t<V>;
    using Node = NodeEnd<V, F>;
    using Block = NodeBlock<V, F>;

    /// @param area  of a square of one step, on the chart
    BlockNeeds(const ReceiverPixels<V>& pixels, const Refinement& rule, double area)
        : pixels_(pixels), rule_(rule), area_(area) {}

    /// @param place, step  of the block's first corner, and of its cells' sides
    /// @param known        known(place) -> NodeEnds: nodes that have been traced
    template <class Known>
    [[nodiscard]] BlockNeed operator()(const Block& block, const LatticePlace& place, std::int64_t step,
                                       const Known& known) const {
        const Extent extent(block);
        if (!reaches_vertices(extent))
            return {};
        const double pixel = pixels_.pixel_at(extent.middle());
        double broken = 0, brightest = 0;
        for (const auto& row : block)
            for (const NodeEnds<V, F>& ends : row)
                for (const Node& end : ends) {
                    const double power = flux_traits<F>::power(end.density);
                    brightest = (std::max)(brightest, power);
                    if (power > broken && !is_whole<V, F>(block, end.signature, pixel))
                        broken = power;
                }
        if (broken > 0)
            return need_of_broken(block, extent.size() * broken / brightest, pixel);
        BlockNeed need;
        for (const Node& end : block[0][0]) {
            const Miss miss = largest_miss<V, F>(block, place, step, known, end.signature, pixel);
            const double allowed =
                (std::min)(rule_.tolerance * pixel, (std::max)(rule_.relative * miss.size, 0.02 * pixel));
            // The miss of the four cells' patches is an eighth of the block's.
            need.ratio = (std::max)(need.ratio, float(miss.furthest / (8 * allowed)));
        }
        return need;
    }

    /// About how much of a block's flux reaches vertices, from the mean density of its nodes.
    [[nodiscard]] double seen_flux(const Block& block, std::int64_t step) const {
        return reaches_vertices(Extent(block)) ? density(block) * 4 * area_ * double(step) * double(step) : 0;
    }

private:
    /// The box of a block's ends.
    struct Extent {
        Box<double> box = empty_box<double>();

        explicit Extent(const Block& block) {
            for (const auto& row : block)
                for (const NodeEnds<V, F>& ends : row)
                    for (const Node& end : ends)
                        include(box, double3(end.position));
        }

        [[nodiscard]] double size() const {
            return (std::max)({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
        }
        [[nodiscard]] Double3 middle() const {
            return {0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1]),
                    0.5 * (box.low[2] + box.high[2])};
        }
    };

    /// Whether a block's box, enlarged by half of its size, overlaps footprints.
    [[nodiscard]] bool reaches_vertices(const Extent& extent) const {
        Box<double> box = extent.box;
        if (!(box.low[0] <= box.high[0]))
            return false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double room = 0.5 * (box.high[axis] - box.low[axis]) + 0.02 * pixels_.largest_pixel();
            box.low[axis] -= room, box.high[axis] += room;
        }
        bool met = false;
        pixels_.visit_leaves(narrowed_box<T>(box), [&](std::uint32_t) { met = true; });
        return met;
    }

    /// A broken block that is smaller than a quarter of a pixel need not be split, unless so few of its nodes are lit
    /// that most of a sheet may be missed.
    ///
    /// @param size  of the block, times the part of the brightest light that the brightest broken sheet has
    [[nodiscard]] static BlockNeed need_of_broken(const Block& block, double size, double pixel) {
        if (count_lit<V, F>(block) < 5)
            return {(std::max)(float(4 * size / pixel), 2.0f), true};
        return {float(4 * size / pixel), true};
    }

    /// The mean flux per area of the chart.
    [[nodiscard]] static double density(const Block& block) {
        double sum = 0;
        for (const auto& row : block)
            for (const NodeEnds<V, F>& ends : row)
                for (const Node& end : ends)
                    sum += flux_traits<F>::power(end.density) / 9;
        return sum;
    }

    const ReceiverPixels<V>& pixels_;
    const Refinement& rule_;
    double area_;
};

} // namespace nephroid::detail
