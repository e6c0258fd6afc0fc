// SPDX-License-Identifier: MIT
/// @file  A receiver's vertices as sheets see them: each with its pixel's footprint, sixteen neighbours together.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/sheet/double3.hpp"
#include "nephroid/vector/frame.hpp"

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

/// The parallelogram around a vertex over which its pixel sees the surface: ± half of each side from its middle.
template <Vector3 V>
struct PixelFootprint {
    V side_u, side_v; ///< in the tangent plane, world units, not parallel
};

namespace detail {

/// All that is read of a vertex while light is added to it, in one line of cache (of floats).
template <Scalar T>
struct alignas(16 * sizeof(T)) PixelRecord {
    std::array<T, 3> position;     ///< relative to the tree's origin
    std::array<T, 3> row_u, row_v; ///< dual to the footprint's sides: s = row_u · (x − position) + ½
    std::array<T, 3> normal;
    T inverse_area;     ///< of the footprint
    std::uint32_t slot; ///< of the tree's leaf order
};

/// Up to sixteen neighbouring vertices.
template <Scalar T>
struct PixelGroup {
    static constexpr std::size_t most = 16;

    std::array<std::array<T, most>, 3> position; ///< by axis; beyond `size` it repeats the last one
    Box<T> box;                ///< about their footprints, with a little room for what lies just above or below
    std::array<T, 3> reach;    ///< how far a footprint goes from its vertex along each axis, the largest
    std::uint32_t first, size; ///< of the records
    T pixel, largest;          ///< the roots of the smallest and the largest footprint's area
};

/// A leaf's groups.
template <Scalar T>
struct PixelLeaf {
    std::uint32_t first, size;
    Box<T> box;   ///< about its footprints
    T pixel;      ///< the smallest of its groups'
    T largest{0}; ///< the root of the largest footprint's area
};

/// The vertices of a receiver, laid out anew for drawing: 96 to 130 bytes each in float.
template <Vector3 V>
class ReceiverPixels {
public:
    using T = scalar_t<V>;
    using Group = PixelGroup<T>;
    using Record = PixelRecord<T>;

    /// @param map  must outlive this
    /// @param footprint  footprint(slot, leaf) -> PixelFootprint<V>: of the vertex in that slot of the tree; called from
    ///                   several threads
    template <class Footprint, class E>
    ReceiverPixels(const EyePathMap<V>& map, const Footprint& footprint, E& executor) : map_(&map) {
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
            part(std::span(slots).first(range.size), footprint, place);
            join(leaves_[leaf]);
        });
        for (const PixelLeaf<T>& leaf : leaves_)
            largest_pixel_ = (std::max)(largest_pixel_, double(leaf.largest));
        draw_boxes();
    }
    /// Squares of the vertices' spacing, turned as `frame_about` the normal turns them.
    template <class E>
    ReceiverPixels(const EyePathMap<V>& map, E& executor)
        : ReceiverPixels(
              map,
              [&map](std::size_t slot, std::uint32_t leaf) {
                  const T side = map.leaf(leaf).spacing;
                  const Frame<V> frame =
                      frame_about(make_vector<V>(map.normal_x()[slot], map.normal_y()[slot], map.normal_z()[slot]));
                  return PixelFootprint<V>{side * frame.u, side * frame.v};
              },
              executor) {}

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
        wide_.visit_leaves(nodes_, box, visit);
    }

    [[nodiscard]] double largest_pixel() const { return largest_pixel_; }

    /// The side of a pixel around a place relative to the tree's origin, world units; the receiver must not be empty.
    [[nodiscard]] double pixel_at(const Double3& place) const {
        const std::array<T, 3> p{T(place.x), T(place.y), T(place.z)};
        return double(leaves_[wide_.nearest_leaf(nodes_, p)].pixel);
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
    template <class Footprint>
    void part(std::span<std::uint32_t> slots, const Footprint& footprint, Place& place) {
        if (slots.size() <= most) {
            fill_group(slots, footprint, place);
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
        part(slots.first(half), footprint, place);
        part(slots.subspan(half), footprint, place);
    }

    template <class Footprint>
    void fill_group(std::span<const std::uint32_t> slots, const Footprint& footprint, Place& place) {
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
                add_record(group, slot, p, footprint(slot, place.leaf), records_.items[place.record++]);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T room = T(0.03) * (std::max)({group.reach[0], group.reach[1], group.reach[2]});
            group.box.low[axis] = group.box.low[axis] - room, group.box.high[axis] = group.box.high[axis] + room;
        }
    }

    void add_record(Group& group, std::uint32_t slot, const std::array<T, 3>& p, PixelFootprint<V> f, Record& record) {
        using t = vector_traits<V>;
        const V normal = make_vector<V>(map_->normal_x()[slot], map_->normal_y()[slot], map_->normal_z()[slot]);
        V across = cross(f.side_u, f.side_v);
        if (dot(across, normal) < T(0)) { // counter-clockwise as seen from the side that is lit
            std::swap(f.side_u, f.side_v);
            across = -across;
        }
        const T area = length(across);
        // Light over a footprint without area would be infinite: such a vertex sees none.
        const T inverse = area > T(0) && isfinite(area) ? T(1) / area : T(0);
        const V unit = inverse * across;
        const V row_u = inverse * cross(f.side_v, unit), row_v = inverse * cross(unit, f.side_u);
        const auto array = [](const V& v) { return std::array<T, 3>{t::x(v), t::y(v), t::z(v)}; };
        record = {p, array(row_u), array(row_v), array(normal), inverse, slot};
        const std::array<T, 3> u = array(f.side_u), v = array(f.side_v);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T reach = T(0.5) * (abs(u[axis]) + abs(v[axis]));
            group.reach[axis] = (std::max)(group.reach[axis], reach);
            group.box.low[axis] = (std::min)(group.box.low[axis], p[axis] - reach);
            group.box.high[axis] = (std::max)(group.box.high[axis], p[axis] + reach);
        }
        if (area > T(0)) {
            group.pixel = (std::min)(group.pixel, sqrt(area));
            group.largest = (std::max)(group.largest, sqrt(area));
        }
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

    /// The tree's nodes about footprints instead of points.
    void draw_boxes() {
        const auto nodes = map_->tree().nodes();
        nodes_.assign(nodes.begin(), nodes.end());
        for (std::size_t i = nodes_.size(); i-- > 0;) { // children follow their parents
            nodes_[i].box = nodes_[i].leaf != no_leaf ? leaves_[nodes_[i].leaf].box
                                                      : joined(nodes_[i + 1].box, nodes_[nodes_[i + 1].skip].box);
        }
        if (!nodes_.empty())
            bounds_ = nodes_.front().box;
        wide_ = WideTree<T>(std::span<const TreeNode<T>>(nodes_));
    }

    static constexpr std::uint32_t most = Group::most;
    static constexpr T far_away = std::numeric_limits<T>::infinity();

    const EyePathMap<V>* map_;
    std::vector<PixelLeaf<T>> leaves_;
    Items<Group> groups_;
    Items<Record> records_;
    std::vector<TreeNode<T>> nodes_;
    WideTree<T> wide_;
    double largest_pixel_ = 0;
    Box<T> bounds_{{far_away, far_away, far_away}, {-far_away, -far_away, -far_away}};
};

} // namespace detail
} // namespace nephroid
