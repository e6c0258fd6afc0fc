// SPDX-License-Identifier: MIT
/// @file  A receiver's vertices as sheets see them: each with its pixel's footprint, sixteen neighbours together.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/sheet/double3.hpp"
#include "nephroid/sheet/pixel_group.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace nephroid {

namespace detail {

/// The vertices of a receiver, laid out anew for drawing: 96 to 130 bytes each in float.
template <Vector3 V>
class ReceiverPixels {
public:
    using T = scalar_t<V>;
    using Group = PixelGroup<T>;
    using Record = PixelRecord<T>;

    /// @param map  must outlive this
    template <class E>
    ReceiverPixels(const EyePathMap<V>& map, E& executor) : map_(&map) {
        const auto& tree = map.tree();
        std::uint32_t groups = 0;
        leaves_.reserve(tree.leaves().size());
        for (const TreeLeaf& leaf : tree.leaves()) {
            const std::uint32_t size = groups_in(leaf.size);
            leaves_.push_back({groups, size, {}, T(0)});
            groups += size;
        }
        // Not set to zero: the memory is first touched by the threads that fill it.
        groups_ = {std::unique_ptr<Group[]>(new Group[groups]), groups};
        records_ = {std::unique_ptr<Record[]>(new Record[tree.slots()]), tree.slots()};
        constexpr std::size_t leaves_per_task = 64;
        for_each_index(executor, leaves_.size(), leaves_per_task, [&](std::size_t leaf) {
            std::array<std::uint32_t, PointTree<V>::leaf_size> slots;
            const TreeLeaf& range = tree.leaves()[leaf];
            for (std::uint32_t i = 0; i < range.size; ++i)
                slots[i] = range.first + i;
            Place place{std::uint32_t(leaf), leaves_[leaf].first, range.first};
            part(std::span(slots).first(range.size), place);
            join(leaves_[leaf]);
        });
        for (const PixelLeaf<T>& leaf : leaves_) {
            largest_pixel_ = (std::max)(largest_pixel_, double(leaf.largest));
            bounds_ = joined(bounds_, leaf.box);
        }
    }

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    [[nodiscard]] std::span<const PixelLeaf<T>> leaves() const { return leaves_; }
    [[nodiscard]] std::span<const Group> groups() const { return {groups_.items.get(), groups_.size}; }
    [[nodiscard]] std::span<const Group> groups_of(std::uint32_t leaf) const {
        return groups().subspan(leaves_[leaf].first, leaves_[leaf].size);
    }
    [[nodiscard]] std::span<const Record> records() const { return {records_.items.get(), records_.size}; }

    /// About all footprints, relative to the tree's origin; low > high where there are none.
    [[nodiscard]] const Box<T>& bounds() const { return bounds_; }

    /// Calls visit(leaf) for every leaf with footprints that the box may reach, in the tree's order.
    template <class Visit>
    void visit_leaves(const Box<T>& box, Visit&& visit) const {
        map_->visit_footprints(box, visit);
    }

    [[nodiscard]] double largest_pixel() const { return largest_pixel_; }

    /// The side of a pixel around a place relative to the tree's origin, world units; the receiver must not be empty.
    [[nodiscard]] double pixel_at(const Double3& place) const {
        return double(leaves_[map_->tree().nearest_leaf(make_vector<V>(T(place.x), T(place.y), T(place.z)))].pixel);
    }

private:
    template <class Item>
    struct Items {
        std::unique_ptr<Item[]> items;
        std::size_t size = 0;
    };

    /// Where the next group of a leaf goes.
    struct Place {
        std::uint32_t leaf, group, record;
    };

    /// How many of n vertices come first where more than sixteen are parted in two.
    [[nodiscard]] static std::uint32_t first_part(std::uint32_t n) {
        const std::uint32_t groups = (n + most - 1) / most;
        return (std::min)((groups + 1) / 2 * most, n / 2 + most / 2);
    }

    [[nodiscard]] static std::uint32_t groups_in(std::uint32_t n) {
        return n <= most ? 1 : groups_in(first_part(n)) + groups_in(n - first_part(n));
    }

    /// Splits a leaf's vertices across the longest side of their box until sixteen are left.
    void part(std::span<std::uint32_t> slots, Place& place) {
        if (slots.size() <= most) {
            fill_group(slots, place);
            return;
        }
        const auto& tree = map_->tree();
        const T* const coordinates[3] = {tree.x(), tree.y(), tree.z()};
        std::size_t axis = 0;
        T widest(-1);
        for (std::size_t a = 0; a < 3; ++a) {
            T low = coordinates[a][slots[0]], high = low;
            for (const std::uint32_t slot : slots) {
                low = (std::min)(low, coordinates[a][slot]);
                high = (std::max)(high, coordinates[a][slot]);
            }
            axis = high - low > widest ? a : axis;
            widest = (std::max)(widest, T(high - low));
        }
        const std::size_t half = first_part(std::uint32_t(slots.size()));
        const auto less = [x = coordinates[axis]](auto i, auto j) { return x[i] < x[j] || (!(x[j] < x[i]) && i < j); };
        std::nth_element(slots.begin(), slots.begin() + std::ptrdiff_t(half), slots.end(), less);
        part(slots.first(half), place);
        part(slots.subspan(half), place);
    }

    void fill_group(std::span<const std::uint32_t> slots, Place& place) {
        Group& group = groups_.items[place.group++];
        group.box = {{far_away, far_away, far_away}, {-far_away, -far_away, -far_away}};
        group.reach = {};
        group.first = place.record;
        group.size = std::uint32_t(slots.size());
        group.pixel = far_away;
        group.largest = T(0);
        for (std::size_t i = 0; i < most; ++i) {
            const std::uint32_t slot = slots[(std::min)(i, slots.size() - 1)];
            const auto& tree = map_->tree();
            const std::array<T, 3> p{tree.x()[slot], tree.y()[slot], tree.z()[slot]};
            for (std::size_t axis = 0; axis < 3; ++axis)
                group.position[axis][i] = p[axis];
            if (i < slots.size())
                add_record(group, slot, p, map_->footprint(place.leaf, slot), records_.items[place.record++]);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T room = T(0.03) * (std::max)({group.reach[0], group.reach[1], group.reach[2]});
            group.box.low[axis] = group.box.low[axis] - room, group.box.high[axis] = group.box.high[axis] + room;
        }
    }

    void add_record(Group& group, std::uint32_t slot, const std::array<T, 3>& p, FootprintRows<V> rows,
                    Record& record) {
        using t = vector_traits<V>;
        const V normal = make_vector<V>(map_->normal_x()[slot], map_->normal_y()[slot], map_->normal_z()[slot]);
        if (dot(cross(rows.u, rows.v), normal) < T(0)) // counter-clockwise as seen from the side that is lit
            std::swap(rows.u, rows.v);
        const auto array = [](const V& v) { return std::array<T, 3>{t::x(v), t::y(v), t::z(v)}; };
        record = {p, array(rows.u), array(rows.v), array(normal), rows.inverse_area, slot};
        if (!(rows.inverse_area > T(0))) // sees nothing
            return;
        // The sides from the rows, whose dual basis they are.
        const T area = T(1) / rows.inverse_area;
        const V across = area * cross(rows.u, rows.v);
        const std::array<T, 3> u = array(V(area * cross(rows.v, across))), v = array(V(area * cross(across, rows.u)));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T reach = T(0.5) * (abs(u[axis]) + abs(v[axis]));
            group.reach[axis] = (std::max)(group.reach[axis], reach);
            group.box.low[axis] = (std::min)(group.box.low[axis], p[axis] - reach);
            group.box.high[axis] = (std::max)(group.box.high[axis], p[axis] + reach);
        }
        group.pixel = (std::min)(group.pixel, sqrt(area));
        group.largest = (std::max)(group.largest, sqrt(area));
    }

    void join(PixelLeaf<T>& leaf) const {
        const Group& first = groups_.items[leaf.first];
        leaf.box = first.box, leaf.pixel = first.pixel, leaf.largest = first.largest;
        for (std::uint32_t i = 1; i < leaf.size; ++i) {
            const Group& group = groups_.items[leaf.first + i];
            leaf.box = joined(leaf.box, group.box);
            leaf.pixel = (std::min)(leaf.pixel, group.pixel);
            leaf.largest = (std::max)(leaf.largest, group.largest);
        }
    }

    [[nodiscard]] static Box<T> joined(const Box<T>& a, const Box<T>& b) {
        Box<T> both;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            both.low[axis] = (std::min)(a.low[axis], b.low[axis]);
            both.high[axis] = (std::max)(a.high[axis], b.high[axis]);
        }
        return both;
    }

    static constexpr std::uint32_t most = Group::most;
    static constexpr T far_away = std::numeric_limits<T>::infinity();

    const EyePathMap<V>* map_;
    std::vector<PixelLeaf<T>> leaves_;
    Items<Group> groups_;
    Items<Record> records_;
    double largest_pixel_ = 0;
    Box<T> bounds_{{far_away, far_away, far_away}, {-far_away, -far_away, -far_away}};
};

} // namespace detail
} // namespace nephroid
