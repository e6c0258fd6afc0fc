// SPDX-License-Identifier: MIT
/// @file  A bounding volume hierarchy with eight children a node, over anything that has bounds.
#pragma once

#include "common/ray.hpp"

#include "nephroid/vector/error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// Asks for an object's cache lines ahead of time, where the compiler knows how.
template <class Object>
void prefetch(const Object* object) {
#if defined(__GNUC__)
    for (std::size_t offset = 0; offset < sizeof(Object); offset += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(object) + offset);
#endif
}

/// Some numbers at once, by GCC's and Clang's own extension: as many as one register of any machine holds.
template <class T>
struct RegisterOf {
    typedef T type __attribute__((vector_size(16)));
    static constexpr std::size_t lanes = 16 / sizeof(T);
};

/// Of a register's comparisons those that are true, as bits: that of lane i has the number first + i.
template <class Results>
[[nodiscard]] Results bits_from(std::size_t first, const Results& results) {
    Results bits;
    for (int i = 0; i < int(sizeof(Results) / sizeof(results[0])); ++i)
        bits[i] = 1 << (int(first) + i);
    return results & bits;
}

/// The bits of all lanes together.
template <class Bits>
[[nodiscard]] unsigned all_bits(const Bits& bits) {
    using Halves = typename RegisterOf<long long>::type;
    const Halves halves = reinterpret_cast<Halves>(bits);
    const auto both = static_cast<unsigned long long>(halves[0] | halves[1]);
    return static_cast<unsigned>(both | both >> 32);
}

/// The hierarchy knows the primitives' bounds alone. Its leaves are numbered from 0 without gaps; what lies in leaf l
/// is `leaf(l)`, and whoever owns the primitives may lay them out in that order.
///
/// Built top down: the largest child is split until a node has eight, by the surface area heuristic over 16 bins.
/// No box that a ray meets in exact arithmetic is missed.
template <class T>
class Bvh {
public:
    static constexpr std::size_t width = 8;

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
    /// @param visit  `visit(leaf number, t_max) -> T`: the distance beyond which nothing matters any more: that of a
    ///               nearer hit, t_max if there is none, or less than t_min to end the search
    /// @param expect  `expect(leaf number)` is told of leaves that may be visited soon: for prefetching
    template <class Visit, class Expect>
    void traverse(const Ray<T>& ray, Visit&& visit, Expect&& expect) const {
        if (nodes_.empty() || !(dot(ray.direction, ray.direction) >= 0)) // absent children are no number either
            return;
        const Slabs slabs(ray);
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
    struct Primitive {
        Box<T> box;
        std::uint32_t index;
    };

    using Lanes = typename RegisterOf<T>::type;

    /// Planes by axis, the lower ones first: x_min, x_max, y_min, ...; an absent child has an empty box.
    using Planes = std::array<std::array<T, width>, 6>;

    struct alignas(64) Node {
        Planes planes;
        std::array<std::uint32_t, width> children; ///< a node's index, or a leaf's number with `leaf_flag`
    };

    static constexpr std::uint32_t leaf_flag = 0x80000000u;
    static constexpr int bin_count = 16;
    static constexpr int max_heuristic_depth = 40; ///< from there on the halves are equal: 16 levels for 2^32
    static constexpr std::size_t max_pending = (width - 1) * (max_heuristic_depth + 16) + width;

    /// What is on the stack is fetched while nearer things are looked at.
    template <class Expect>
    void announce(std::uint32_t child, Expect& expect) const {
        if (child & leaf_flag)
            expect(child & ~leaf_flag);
        else
            prefetch(&nodes_[child]);
    }

    /// A ray as the slab test wants it.
    class Slabs {
    public:
        explicit Slabs(const Ray<T>& ray) {
            // By more than the rounding of (plane − origin) · (1 / direction), so that no box is missed.
            // Source: Ize 2013, "Robust BVH Ray Traversal".
            constexpr T stretch = T(1) + T(4) * std::numeric_limits<T>::epsilon();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const T inverse = T(1) / ray.direction[int(axis)];
                origin_[axis] = Lanes{} + ray.origin[int(axis)];
                inverse_[axis] = Lanes{} + inverse;
                stretched_[axis] = Lanes{} + inverse * stretch;
                near_[axis] = 2 * axis + (inverse < T(0) ? 1 : 0);
            }
        }

        /// Where the ray enters each of a node's boxes.
        ///
        /// @return  the boxes that it meets, as bits. 0 · infinity (in a plane, and parallel to it) fails each
        ///          comparison and bounds nothing.
        [[nodiscard]] unsigned enter(const Planes& planes, T t_min, T t_max, std::array<T, width>& t) const {
            decltype(Lanes{} < Lanes{}) hit{};
            for (std::size_t first = 0; first < width; first += RegisterOf<T>::lanes) {
                Lanes from = Lanes{} + t_min, to = Lanes{} + t_max;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    Lanes low, high;
                    std::memcpy(&low, &planes[near_[axis]][first], sizeof low);
                    std::memcpy(&high, &planes[near_[axis] ^ 1][first], sizeof high);
                    const Lanes a = (low - origin_[axis]) * inverse_[axis];
                    const Lanes b = (high - origin_[axis]) * stretched_[axis];
                    from = a > from ? a : from;
                    to = b < to ? b : to;
                }
                std::memcpy(&t[first], &from, sizeof from);
                hit |= bits_from(first, from <= to);
            }
            return all_bits(hit);
        }

    private:
        std::array<Lanes, 3> origin_, inverse_, stretched_;
        std::array<std::size_t, 3> near_;
    };

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
        std::array<Child, width> children{Child{all, bounds_of(all)}};
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
            const std::size_t half = depth < max_heuristic_depth ? partition(split) : halve(split);
            *largest = {split.first(half), bounds_of(split.first(half))};
            children[count++] = {split.subspan(half), bounds_of(split.subspan(half))};
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

    /// Reorders by the cheapest of the splits between bins; returns the size of the lower part, never 0 or all.
    std::size_t partition(std::span<Primitive> primitives) const {
        struct Bin {
            Box<T> box;
            std::size_t count = 0;
        };
        Box<T> centres;
        for (const Primitive& primitive : primitives)
            centres.add(centre(primitive));

        T least_cost = std::numeric_limits<T>::infinity();
        int best_axis = -1, best_split = 0;
        const auto bin_of = [&](const Primitive& primitive, int axis) {
            const T scale = T(bin_count) / (centres.max[axis] - centres.min[axis]);
            return (std::min)(int((centre(primitive)[axis] - centres.min[axis]) * scale), bin_count - 1);
        };
        for (int axis = 0; axis < 3; ++axis) {
            // Also false where a scale would overflow.
            if (!(centres.max[axis] - centres.min[axis] > T(bin_count) * (std::numeric_limits<T>::min)()))
                continue;
            std::array<Bin, bin_count> bins;
            for (const Primitive& primitive : primitives) {
                Bin& bin = bins[static_cast<std::size_t>(bin_of(primitive, axis))];
                bin.box.add(primitive.box);
                ++bin.count;
            }
            std::array<T, bin_count> cost_above{};
            Box<T> box;
            std::size_t count = 0;
            for (std::size_t i = bin_count - 1; i > 0; --i) {
                box.add(bins[i].box);
                count += bins[i].count;
                cost_above[i] = count == 0 ? std::numeric_limits<T>::infinity() : box.half_area() * leaves_for(count);
            }
            box = {};
            count = 0;
            for (std::size_t i = 1; i < bin_count; ++i) {
                box.add(bins[i - 1].box);
                count += bins[i - 1].count;
                const T cost = box.half_area() * leaves_for(count) + cost_above[i];
                if (count > 0 && cost < least_cost) {
                    least_cost = cost;
                    best_axis = axis;
                    best_split = int(i);
                }
            }
        }
        if (best_axis < 0) // all centres coincide
            return primitives.size() / 2;
        const auto above = std::partition(primitives.begin(), primitives.end(), [&](const Primitive& primitive) {
            return bin_of(primitive, best_axis) < best_split;
        });
        return static_cast<std::size_t>(above - primitives.begin());
    }

    static std::size_t halve(std::span<Primitive> primitives) {
        Box<T> centres;
        for (const Primitive& primitive : primitives)
            centres.add(centre(primitive));
        const Vec3<T> d = centres.max - centres.min;
        const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
        const auto middle = primitives.begin() + static_cast<std::ptrdiff_t>(primitives.size() / 2);
        std::nth_element(primitives.begin(), middle, primitives.end(),
                         [axis](const Primitive& a, const Primitive& b) { return centre(a)[axis] < centre(b)[axis]; });
        return primitives.size() / 2;
    }

    std::size_t leaf_size_ = 4;
    Box<T> bounds_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;       ///< primitives by leaf
    std::vector<std::size_t> leaf_begin_{0}; ///< into `order_`, and its end
};

} // namespace nephroid::examples
