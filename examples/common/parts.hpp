// SPDX-License-Identifier: MIT
/// @file  The parts of a scene, each a shape with a material, in a tree that finds the first one that a ray meets.
#pragma once

#include "common/shapes.hpp"

#include "nephroid/vector/in_place.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples {

/// @tparam T  float or double
template <class T>
class Parts {
public:
    struct Part {
        Shape<T> shape;
        std::size_t material = 0; ///< ignored for meshes, whose triangles have their own
    };

    Parts() = default;
    explicit Parts(std::vector<Part> parts) : parts_(std::move(parts)) {
        std::vector<Box<T>> boxes;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Box<T> box = bounds_of(parts_[i]);
            if (!box.is_finite()) { // also an empty mesh
                unbounded_.push_back(i);
            } else {
                bounded_.push_back(i);
                boxes.push_back(box);
            }
        }
        bvh_ = Bvh<T>(boxes, 1);
    }

    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    [[nodiscard]] bool empty() const { return parts_.empty(); }

    /// The bounds of all bounded shapes; empty if there are none.
    [[nodiscard]] const Box<T>& bounds() const { return bvh_.bounds(); }
    [[nodiscard]] static Box<T> bounds_of(const Part& part) {
        return std::visit([](const auto& shape) { return shape.bounds(); }, part.shape);
    }

    /// Whether a ray meets anything; faster than `intersect`.
    [[nodiscard]] bool occluded(const Vec3<T>& origin, const Vec3<T>& direction, T t_min, T t_max) const {
        const Ray<T> ray{origin, direction, t_min, t_max};
        const auto blocks = [&](std::size_t i) {
            return std::visit(
                [&](const auto& shape) {
                    if constexpr (requires { shape.occludes(ray); })
                        return shape.occludes(ray);
                    else
                        return shape.nearest(ray, wide_t<T>(t_max)).has_value();
                },
                parts_[i].shape);
        };
        if (std::any_of(unbounded_.begin(), unbounded_.end(), blocks))
            return true;
        bool found = false;
        visit_bounded(ray, [&](std::size_t i, T nearest) {
            found = blocks(i);
            return found ? -std::numeric_limits<T>::infinity() : nearest;
        });
        return found;
    }

protected:
    /// The nearest hit. If surfaces touch there, the order says which one comes first.
    ///
    /// @tparam Order  AnyOrder or a ContactOrder
    template <class Order>
    [[nodiscard]] std::optional<Hit<T>> nearest_hit(const Ray<T>& ray, Order order) const {
        std::optional<Candidate<T>> best;
        std::size_t best_part = 0;
        wide_t<T> nearest(ray.t_max);
        const auto take = [&](std::size_t i, const Candidate<T>& found) {
            best = found;
            best_part = i;
            nearest = found.distance;
            if constexpr (Order::matters)
                nearest = (std::min)(furthest_contact(ray, nearest), wide_t<T>(ray.t_max));
        };
        const auto try_part = [&](std::size_t i) {
            if constexpr (Order::matters) {
                order.part = i;
                if (const auto found = nearest_of(i, ray, nearest, order))
                    if (!best || comes_first(ray, i, *found, best_part, *best, order))
                        take(i, *found);
            } else {
                if (const auto found =
                        std::visit([&](const auto& shape) { return shape.nearest(ray, nearest); }, parts_[i].shape))
                    take(i, *found);
            }
        };
        for (const std::size_t i : unbounded_)
            try_part(i);
        visit_bounded({ray.origin, ray.direction, ray.t_min, T(nearest)}, [&](std::size_t i, T) {
            try_part(i);
            return T(nearest);
        });
        if (!best)
            return std::nullopt;

        const Part& part = parts_[best_part];
        const auto fill_in = [&](const auto& shape) {
            Hit<T> hit = shape.hit(ray, *best);
            if constexpr (!std::is_same_v<std::decay_t<decltype(shape)>, TriangleMesh<T>>)
                hit.surface = part.material;
            hit.primitive = primitive_of(best_part, *best);
            return hit;
        };
        return std::optional<Hit<T>>(std::in_place, InPlace{[&] { return std::visit(fill_in, part.shape); }});
    }

private:
    /// The largest distance of hits that may touch one at this distance.
    [[nodiscard]] static wide_t<T> furthest_contact(const Ray<T>& ray, const wide_t<T>& distance) {
        return distance + flattest * contact_height(ray, distance);
    }
    static constexpr wide_t<T> flattest = 16; ///< 1 / sine of the flattest ray whose contacts are considered

    [[nodiscard]] static std::uint64_t primitive_of(std::size_t part, const Candidate<T>& candidate) {
        return std::uint64_t(part) << 32 | candidate.primitive;
    }

    /// A part's nearest hit that is not left out. Of a shape that is not a mesh, at most two hits are left out.
    template <class Order>
    [[nodiscard]] std::optional<Candidate<T>> nearest_of(std::size_t part, Ray<T> ray, const wide_t<T>& t_max,
                                                         const Order& order) const {
        return std::visit(
            [&](const auto& shape) -> std::optional<Candidate<T>> {
                if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, TriangleMesh<T>>) {
                    return shape.nearest(ray, t_max, order);
                } else {
                    if (order.was_left(0))
                        ray.t_min = order.contacts.reach();
                    auto found = shape.nearest(ray, t_max);
                    const auto slope = [&] { return cosine_at(shape, ray, *found); };
                    while (found && order.leaves_out(0, found->distance, slope)) {
                        const T here =
                            T(found->distance); // a little more, because rounding may have put the hit too near
                        ray.t_min = here + (T(2) * std::numeric_limits<T>::epsilon() * abs(here) +
                                            (std::numeric_limits<T>::min)());
                        found = shape.nearest(ray, t_max);
                    }
                    return found;
                }
            },
            parts_[part].shape);
    }

    template <class S>
    [[nodiscard]] static wide_t<T> cosine_at(const S& shape, const Ray<T>& ray, const Candidate<T>& found) {
        if constexpr (std::is_same_v<S, TriangleMesh<T>>)
            return shape.cosine(ray, found.primitive);
        else
            return wide_t<T>(dot(ray.direction, shape.hit(ray, found).geometric_normal));
    }

    /// Whether a hit comes before the best one so far, which is on another part.
    template <class Order>
    [[nodiscard]] bool comes_first(const Ray<T>& ray, std::size_t part, const Candidate<T>& found,
                                   std::size_t best_part, const Candidate<T>& best, const Order& order) const {
        const bool is_nearer = found.distance < best.distance;
        const auto slope_of = [&](std::size_t i, const Candidate<T>& candidate) {
            return std::visit([&](const auto& shape) { return cosine_at(shape, ray, candidate); }, parts_[i].shape);
        };
        const wide_t<T> apart = abs(found.distance - best.distance), height = contact_height(ray, found.distance);
        const std::size_t mine = material_of(part, found), others = material_of(best_part, best);
        if (mine == others || apart > flattest * height)
            return is_nearer;
        const wide_t<T> slope = slope_of(part, found);
        if (apart * wide_t<T>(abs(slope)) > height)
            return is_nearer;
        const int rank = order.rank(mine, slope > 0), other = order.rank(others, slope_of(best_part, best) > 0);
        return rank < other || (rank == other && is_nearer);
    }

    [[nodiscard]] std::size_t material_of(std::size_t part, const Candidate<T>& candidate) const {
        const auto* mesh = std::get_if<TriangleMesh<T>>(&parts_[part].shape);
        return mesh ? mesh->material(candidate.primitive) : parts_[part].material;
    }

    /// Visits the bounded parts as `Bvh::traverse` visits leaves. A single part, perhaps a mesh with a tree of its own,
    /// needs no tree.
    template <class Visit>
    void visit_bounded(const Ray<T>& ray, const Visit& visit) const {
        if (bounded_.size() == 1)
            visit(bounded_.front(), ray.t_max);
        else
            bvh_.traverse(ray,
                          [&](std::uint32_t leaf, T t_max) { return visit(bounded_[bvh_.leaf(leaf).front()], t_max); });
    }

    std::vector<Part> parts_;
    std::vector<std::size_t> bounded_, unbounded_; ///< indices of parts
    Bvh<T> bvh_;                                   ///< over the bounded parts
};

} // namespace nephroid::examples
