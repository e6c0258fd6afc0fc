// SPDX-License-Identifier: MIT
/// @file  A receiver's vertices in the layout in which sheets are drawn onto them: groups of up to sixteen neighbours,
///        with bounds of their pixel footprints.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/vector/double3.hpp"
#include "nephroid/sheet/pixel_group.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace nephroid {

namespace detail {

/// The positions of a receiver's vertices, copied into groups for drawing: 16 bytes per vertex in float. What else is
/// read of a vertex is computed where light falls on it (`record`).
template <Vector3 V>
class ReceiverPixels {
public:
    using T = scalar_t<V>;
    using Group = PixelGroup<T>;

    /// @param map  must outlive this
    template <class E>
    ReceiverPixels(const EyePathMap<V>& map, E& executor) : map_(&map), view_(map.view()) {
        const auto& tree = map.tree();
        std::uint32_t groups = 0;
        leaves_.reserve(tree.leaves().size());
        for (std::size_t node = 0; node < tree.nodes().size(); ++node) {
            if (tree.nodes()[node].leaf == no_leaf) // leaves are in the order of their nodes
                continue;
            const std::uint32_t size = groups_in(tree.leaves()[leaves_.size()].size);
            std::array<T, 3> reach = map.node(std::uint32_t(node)).reach;
            for (T& along : reach)
                along = T(1.01) * along; // positions are rounded by far less than a hundredth
            leaves_.push_back({groups, size, empty_box<T>(), reach, far_away, T(0), T(0)});
            groups += size;
        }
        // Not set to zero: the memory is first touched by the threads that fill it.
        groups_ = {std::unique_ptr<Group[]>(new Group[groups]), groups};
        constexpr std::size_t leaves_per_task = 64;
        for_each_index(executor, leaves_.size(), leaves_per_task, [&](std::size_t leaf) { fill(leaf); });
        for (const PixelLeaf<T>& leaf : leaves_) {
            largest_pixel_ = (std::max)(largest_pixel_, double(leaf.largest));
            area_ += double(leaf.area);
            bounds_.add(leaf.box);
        }
    }

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    [[nodiscard]] std::span<const PixelLeaf<T>> leaves() const { return leaves_; }
    [[nodiscard]] std::span<const Group> groups() const { return {groups_.items.get(), groups_.size}; }
    [[nodiscard]] std::span<const Group> groups_of(std::uint32_t leaf) const {
        return groups().subspan(leaves_[leaf].first, leaves_[leaf].size);
    }

    /// What is read of the vertex in a slot of the tree; the slot must be in the leaf.
    [[nodiscard]] PixelRecord<T> record(std::uint32_t leaf, std::size_t slot) const {
        using t = vector_traits<V>;
        const auto& tree = view_.tree();
        const FootprintRows<V> rows = view_.footprint(leaf, slot);
        PixelRecord<T> record{{tree.x()[slot], tree.y()[slot], tree.z()[slot]},
                              {t::x(rows.u), t::y(rows.u), t::z(rows.u)},
                              {t::x(rows.v), t::y(rows.v), t::z(rows.v)},
                              {view_.normal_x()[slot], view_.normal_y()[slot], view_.normal_z()[slot]},
                              rows.inverse_area};
        const auto &u = record.row_u, &v = record.row_v, &n = record.normal;
        const T turn = (u[1] * v[2] - u[2] * v[1]) * n[0] + (u[2] * v[0] - u[0] * v[2]) * n[1] +
                       (u[0] * v[1] - u[1] * v[0]) * n[2];
        if (turn < T(0)) // counter-clockwise as seen from the side that is lit
            std::swap(record.row_u, record.row_v);
        return record;
    }

    /// The box around all footprints; low > high if there are none.
    [[nodiscard]] const Box<T>& bounds() const { return bounds_; }

    /// Calls visit(leaf) for every leaf with a footprint that the box may overlap, in the tree's order.
    template <class Visit>
    void visit_leaves(const Box<T>& box, Visit&& visit) const {
        view_.visit_footprints(box, visit);
    }

    /// The area of all footprints, world units squared.
    [[nodiscard]] double area() const { return area_; }

    /// The side of the largest pixel, world units: the root of its footprint's area.
    [[nodiscard]] double largest_pixel() const { return largest_pixel_; }

    /// The side of a pixel around a place relative to the tree's origin, world units; the receiver must not be empty.
    [[nodiscard]] double pixel_at(const Double3& place) const {
        return double(leaves_[map_->tree().nearest_leaf(to_world<V>(place))].pixel);
    }

private:
    struct Groups {
        std::unique_ptr<Group[]> items;
        std::size_t size = 0;
    };

    void fill(std::size_t number) {
        PixelLeaf<T>& leaf = leaves_[number];
        measure(number, leaf);
        const TreeLeaf range = map_->tree().leaves()[number];
        const auto& tree = map_->tree();
        const std::array<const T*, 3> position = {tree.x() + range.first, tree.y() + range.first,
                                                  tree.z() + range.first};
        static_assert(PointTree<V>::leaf_size <= LeafParts<T>::most);
        std::array<std::uint8_t, LeafParts<T>::most> slots;
        std::iota(slots.begin(), slots.end(), std::uint8_t(0));
        Group* group = groups_.items.get() + leaf.first;
        LeafParts<T>(position).visit_parts(std::span(slots).first(range.size), [&](auto part) {
            fill_group(part, position, leaf.reach, *group);
            if (leaf.largest > T(0))
                leaf.box.add(group->box);
            ++group;
        });
    }

    /// Sets the sizes of a leaf's footprints.
    void measure(std::size_t number, PixelLeaf<T>& leaf) const {
        const TreeLeaf range = map_->tree().leaves()[number];
        if (!map_->has_footprints()) {
            leaf.largest = map_->leaf(std::uint32_t(number)).spacing;
            leaf.pixel = leaf.largest > T(0) ? leaf.largest : far_away;
            leaf.area = square(leaf.largest) * T(range.size);
            return;
        }
        const T* const inverse_area = view_.arrays().footprint_rows[6] + range.first;
        const auto [least, most] = std::minmax_element(inverse_area, inverse_area + range.size);
        leaf.pixel = *most > T(0) ? T(1) / sqrt(*most) : far_away;
        leaf.largest = *least > T(0) ? T(1) / sqrt(*least) : T(0);
        for (std::uint32_t i = 0; i < range.size; ++i)
            leaf.area = leaf.area + (inverse_area[i] > T(0) ? T(1) / inverse_area[i] : T(0));
    }

    static void fill_group(std::span<const std::uint8_t> slots, const std::array<const T*, 3>& position,
                           const std::array<T, 3>& reach, Group& group) {
        group.size = std::uint32_t(slots.size());
        for (std::size_t i = 0; i < Group::most; ++i)
            group.slot[i] = slots[(std::min)(i, slots.size() - 1)];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t i = 0; i < Group::most; ++i)
                group.position[axis][i] = position[axis][group.slot[i]];
            const auto& all = group.position[axis];
            const auto [low, high] = std::minmax_element(all.begin(), all.end());
            group.box.low[axis] = *low - reach[axis], group.box.high[axis] = *high + reach[axis];
        }
    }

    static constexpr T far_away = std::numeric_limits<T>::infinity();

    const EyePathMap<V>* map_;
    EyePathView<V> view_;
    std::vector<PixelLeaf<T>> leaves_;
    Groups groups_;
    double largest_pixel_ = 0, area_ = 0;
    Box<T> bounds_ = empty_box<T>();
};

} // namespace detail
} // namespace nephroid
