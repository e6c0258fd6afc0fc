// SPDX-License-Identifier: MIT
/// @file  A bounding volume hierarchy with eight children a node, over anything that has bounds.
#pragma once

#include "common/bvh_slabs.hpp"
#include "common/bvh_split.hpp"
#include "common/ray.hpp"

#include "nephroid/vector/error.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// Prefetches an object's cache lines, if the compiler can.
template <class Object>
void prefetch(const Object* object) {
#if defined(__GNUC__)
    for (std::size_t offset = 0; offset < sizeof(Object); offset += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(object) + offset);
#endif
}

/// A hierarchy over the bounds of primitives. Its leaves are numbered from 0 without gaps; `leaf(l)` lists the
/// primitives in leaf l, and their owner may store them in that order.
///
/// It is built top down: the largest child is split until a node has eight. No box that a ray meets in exact arithmetic
/// is missed.
template <class T>
class Bvh {
public:
    static constexpr std::size_t width = Slabs<T>::width;

    Bvh() = default;

    /// @param bounds     of the primitives, finite; an empty range is a hierarchy that nothing hits
    /// @param leaf_size  the most primitives of a leaf, >= 1; a leaf costs the same whether it is full or not
    /// Throws std::invalid_argument for bounds that are empty or not finite.
    explicit Bvh(std::span<const Box<T>> bounds, std::size_t leaf_size = 4) : leaf_size_(leaf_size) {
        std::vector<Primitive> primitives;
        primitives.reserve(bounds.size());
        for (const Box<T>& box : bounds) {
            if (box.is_empty() || !all_finite(T(4) * box.min) || !all_finite(T(4) * box.max))
                invalid_argument("Bvh: the bounds of primitive " + std::to_string(primitives.size()) +
                                 " are empty or not finite");
            primitives.push_back({box, static_cast<std::uint32_t>(primitives.size())});
            bounds_.add(box);
        }
        order_.reserve(bounds.size());
        if (!primitives.empty())
            build(primitives, 0);
    }

    [[nodiscard]] const Box<T>& bounds() const { return bounds_; }
    [[nodiscard]] std::size_t leaf_count() const { return leaf_begin_.size() - 1; }

    /// Indices of the primitives in a leaf.
    [[nodiscard]] std::span<const std::uint32_t> leaf(std::size_t number) const {
        return {order_.data() + leaf_begin_[number], leaf_begin_[number + 1] - leaf_begin_[number]};
    }

    /// Visits the leaves whose boxes the ray meets, the nearest ones first, as far as possible.
    ///
    /// @param visit  `visit(leaf number, t_max) -> T` returns the new t_max: the distance of a nearer hit, the same
    ///               t_max if there is none, or less than t_min to end the search
    /// @param expect  `expect(leaf number)` is called for leaves that may be visited soon, for prefetching
    template <class Visit, class Expect>
    void traverse(const Ray<T>& ray, Visit&& visit, Expect&& expect) const {
        if (nodes_.empty() || !(dot(ray.direction, ray.direction) >= 0)) // absent children are no number either
            return;
        const Slabs<T> slabs(ray);
        struct Pending {
            std::uint32_t child;
            T t;
        };
        std::array<Pending, max_pending> stack;
        std::size_t pending = 0;
        std::uint32_t child = 0;
        T t_max = ray.t_max;
        for (;;) {
            if (child & leaf_flag) {
                t_max = visit(child & ~leaf_flag, t_max);
                if (t_max < ray.t_min)
                    return;
            } else {
                const Node& node = nodes_[child];
                std::array<T, width> t;
                unsigned hit = slabs.enter(node.planes, ray.t_min, t_max, t);
                if (hit != 0) {
                    // On to the nearest one; the others wait, the next nearest on top.
                    auto nearest = std::size_t(std::countr_zero(hit));
                    const std::size_t first = pending;
                    while ((hit &= hit - 1) != 0) {
                        auto other = std::size_t(std::countr_zero(hit));
                        if (t[other] < t[nearest])
                            std::swap(other, nearest);
                        std::size_t place = pending++;
                        for (; place > first && stack[place - 1].t < t[other]; --place)
                            stack[place] = stack[place - 1];
                        stack[place] = {node.children[other], t[other]};
                        announce(node.children[other], expect);
                    }
                    child = node.children[nearest];
                    continue;
                }
            }
            do {
                if (pending == 0)
                    return;
                --pending;
            } while (stack[pending].t > t_max);
            child = stack[pending].child;
        }
    }

    template <class Visit>
    void traverse(const Ray<T>& ray, Visit&& visit) const {
        traverse(ray, visit, [](std::uint32_t) {});
    }

private:
    using Primitive = BvhPrimitive<T>;
    using Split = BvhSplit<T>;

    struct alignas(64) Node {
        typename Slabs<T>::Planes planes;          ///< of the children's boxes
        std::array<std::uint32_t, width> children; ///< a node's index, or a leaf's number with `leaf_flag`
    };

    static constexpr std::uint32_t leaf_flag = 0x80000000u;
    static constexpr int max_heuristic_depth = 40; ///< from there on the halves are equal: 16 levels for 2^32
    static constexpr std::size_t max_pending = (width - 1) * (max_heuristic_depth + 16) + width;

    /// Prefetches the children on the stack while nearer ones are visited.
    template <class Expect>
    void announce(std::uint32_t child, Expect& expect) const {
        if (child & leaf_flag)
            expect(child & ~leaf_flag);
        else
            prefetch(&nodes_[child]);
    }

    static Box<T> bounds_of(std::span<const Primitive> primitives) {
        Box<T> box;
        for (const Primitive& primitive : primitives)
            box.add(primitive.box);
        return box;
    }

    /// Twice the centre: only compared.
    static Vec3<T> centre(const Primitive& primitive) { return primitive.box.min + primitive.box.max; }

    [[nodiscard]] T leaves_for(std::size_t count) const { return T((count + leaf_size_ - 1) / leaf_size_); }

    std::uint32_t build(std::span<Primitive> all, int depth) {
        struct Child {
            std::span<Primitive> primitives;
            Box<T> box;
        };
        const Split splitter(leaf_size_);
        std::array<Child, width> children{Child{all, Split::bounds_of(all)}};
        std::size_t count = 1;
        while (count < width) {
            Child* largest = nullptr; // by area, or by number once equal halves are called for
            for (std::size_t i = 0; i < count; ++i) {
                Child& child = children[i];
                const bool splits = child.primitives.size() > leaf_size_;
                if (splits &&
                    (!largest || (depth < max_heuristic_depth ? child.box.half_area() > largest->box.half_area()
                                                              : child.primitives.size() > largest->primitives.size())))
                    largest = &child;
            }
            if (!largest)
                break;
            const std::span<Primitive> split = largest->primitives;
            const std::size_t half = depth < max_heuristic_depth ? splitter.partition(split) : Split::halve(split);
            *largest = {split.first(half), Split::bounds_of(split.first(half))};
            children[count++] = {split.subspan(half), Split::bounds_of(split.subspan(half))};
        }

        const std::size_t index = nodes_.size();
        nodes_.emplace_back();
        for (std::size_t i = 0; i < width; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                nodes_[index].planes[2 * axis][i] = children[i].box.min[int(axis)];
                nodes_[index].planes[2 * axis + 1][i] = children[i].box.max[int(axis)];
            }
            if (i >= count)
                continue;
            const bool is_leaf = children[i].primitives.size() <= leaf_size_;
            const std::uint32_t child =
                is_leaf ? add_leaf(children[i].primitives) : build(children[i].primitives, depth + 1);
            nodes_[index].children[i] = child;
        }
        return static_cast<std::uint32_t>(index);
    }

    std::uint32_t add_leaf(std::span<const Primitive> primitives) {
        for (const Primitive& primitive : primitives)
            order_.push_back(primitive.index);
        leaf_begin_.push_back(order_.size());
        return static_cast<std::uint32_t>(leaf_count() - 1) | leaf_flag;
    }

    std::size_t leaf_size_ = 4;
    Box<T> bounds_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;       ///< primitives by leaf
    std::vector<std::size_t> leaf_begin_{0}; ///< into `order_`, and its end
};

} // namespace nephroid::examples
