// SPDX-License-Identifier: MIT
/// @file  A scene: shapes and what they are made of, as the library's walk wants it.
#pragma once

#include "common/fresnel.hpp"
#include "common/material.hpp"
#include "common/shapes.hpp"

#include "nephroid/emission/target.hpp"
#include "nephroid/transport/media.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/vector/in_place.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// What a ray flies through: the insides of materials, by their indices.
using Medium = Media;

/// A scene's answer to `scatter`.
template <class T, Flux F>
struct Bounce {
    Event event = Event::absorb;
    F weight = flux_traits<F>::zero();
    T eta = T(1);
    Medium medium = {}; ///< that a refracted ray enters
};

/// Where a ray meets a dielectric, an index and a side at a time.
template <class T>
struct Interface {
    T eta;          ///< n₁/n₂ for this ray
    T cos_incident; ///< with the shading normal, where that faces the ray, else with the geometric one
    Medium beyond;  ///< where a refracted ray goes
    bool is_real;   ///< else the same medium is on both sides, and light does not notice
};

/// Shapes and materials. A surface's inside is where its normal points away from, so a sheet of water over a basin does
/// not need to be closed: a ray that enters it is in water until it leaves it, or ends. Where insides overlap, the
/// material of the higher priority is there, or of those that have the same the one that a ray entered last.
///
/// @tparam T  float or double
/// @tparam F  flux: T, or `glm::vec<3, T>` for red, green and blue
template <class T, Flux F = Vec3<T>>
class Scene {
public:
    using vector = Vec3<T>;
    using flux_type = F;
    using medium = Medium;

    struct Part {
        Shape<T> shape;
        std::size_t material = 0; ///< ignored for meshes, whose triangles have their own
    };

    Scene() = default;

    /// Throws std::invalid_argument for a material that does not exist.
    Scene(std::vector<Part> parts, std::vector<Material<F>> materials)
        : parts_(std::move(parts)), materials_(std::move(materials)) {
        std::vector<Box<T>> boxes;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            require_materials(i);
            const Box<T> box = std::visit([](const auto& shape) { return shape.bounds(); }, parts_[i].shape);
            if (!box.is_finite()) { // also an empty mesh
                unbounded_.push_back(i);
            } else {
                bounded_.push_back(i);
                boxes.push_back(box);
            }
            collect_specular(parts_[i], box);
        }
        bvh_ = Bvh<T>(boxes, 1);
    }

    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    [[nodiscard]] const std::vector<Material<F>>& materials() const { return materials_; }
    [[nodiscard]] const Material<F>& material(const Hit<T>& hit) const { return materials_[hit.surface]; }
    [[nodiscard]] const F& color(const Hit<T>& hit) const { return material(hit).color; }
    [[nodiscard]] bool empty() const { return parts_.empty(); }

    /// Whether anything can make a caustic.
    [[nodiscard]] bool has_specular() const { return has_specular_; }

    /// Points whose convex hull holds all bounded specular surfaces: vertices of meshes, corners of boxes of others.
    /// What `smallest_beam_over` and `bounding_sphere` want. Empty where there are none.
    [[nodiscard]] const std::vector<Vec3<T>>& specular_points() const { return specular_points_; }

    /// Nothing where no bounded surface is specular.
    [[nodiscard]] std::optional<BoundingSphere<Vec3<T>>> specular_bounds() const {
        if (specular_points_.empty())
            return std::nullopt;
        return bounding_sphere(specular_points_);
    }

    /// The bounds of all bounded shapes; empty if there are none.
    [[nodiscard]] const Box<T>& bounds() const { return bvh_.bounds(); }

    [[nodiscard]] std::optional<Hit<T>> intersect(const Vec3<T>& origin, const Vec3<T>& direction, T t_min,
                                                  T t_max) const {
        return nearest_hit({origin, direction, t_min, t_max}, AnyOrder());
    }

    /// Without what the ray has just left; surfaces that touch come in the order that light passes them.
    [[nodiscard]] std::optional<Hit<T>> intersect(const Vec3<T>& origin, const Vec3<T>& direction, T t_min, T t_max,
                                                  const Contacts<T>& contacts) const {
        // Into the next glass before out of the last, so that there is no air between; out of that before the table.
        const auto rank = [this](std::size_t material, bool leaves) {
            const bool is_glass = materials_[material].surface == Surface::dielectric;
            return is_glass ? (leaves ? 1 : 0) : 2;
        };
        return nearest_hit({origin, direction, t_min, t_max}, ContactOrder<T, decltype(rank)>{contacts, rank});
    }

    /// Whether anything lies between: faster than `intersect`.
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

    /// For rays that do not know what they fly through: nothing is inside of anything else.
    template <class Sampler>
    [[nodiscard]] Bounce<T, F> scatter(const Hit<T>& hit, const Vec3<T>& direction, Sampler& sampler) const {
        return scatter(hit, direction, sampler, Medium{});
    }

    /// @param direction  that the photon flies in, unit
    /// @param sampler    drawn from once, and only where there is a choice: between a dielectric's reflection and
    ///                   refraction if both are followed, and between the parts of a mixture
    /// @param through    what the photon comes through
    template <class Sampler>
    [[nodiscard]] Bounce<T, F> scatter(const Hit<T>& hit, const Vec3<T>& direction, Sampler& sampler,
                                       const Medium& through) const {
        const Material<F>& m = material(hit);
        if (m.is_mixture())
            return scatter_mixture(m, hit, direction, through, sampler.template next<T>());
        switch (m.surface) {
        case Surface::diffuse:
            return {Event::deposit};
        case Surface::mirror:
        case Surface::conductor:
            return {Event::reflect, reflectance(m, hit, direction)};
        case Surface::dielectric:
            break;
        case Surface::window:
            return scatter_mixture(m, hit, direction, through, sampler.template next<T>());
        case Surface::black:
            return {Event::absorb};
        }

        const Interface<T> at = interface(m, hit, direction, through);
        if (!at.is_real)
            return {Event::pass, grey<F>(1), T(1), at.beyond};
        const T reflected = reflectance(m, at);
        if (m.follow == Follow::refraction)
            return reflected < T(1) ? refracted(hit, at, T(1) - reflected) : Bounce<T, F>{};
        if (reflected >= T(1) || (reflected > T(0) && sampler.template next<T>() < reflected))
            return {Event::reflect, grey<F>(1)};
        return refracted(hit, at, T(1));
    }

    /// The shares of the light that meets a surface, which add up to 1 with what is absorbed.
    struct Shares {
        T missed;    ///< passes unbent where the surface is not
        T reflected; ///< by a dielectric or a window
        T passed;    ///< goes through a dielectric, bent, or a window, unbent
    };

    /// What becomes of light at a mixture, whose rest is diffuse, or what its surface is.
    [[nodiscard]] Shares shares(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction,
                                const Medium& through = Medium{}) const {
        const T covered = T(m.coverage);
        if (!m.passes_light())
            return {T(1) - covered, T(0), T(0)};
        T reflected = reflectance(m, interface(m, hit, direction, through));
        if (m.surface == Surface::window) // there and back between its faces, summed up
            reflected = T(2) * reflected / (T(1) + reflected);
        return {T(1) - covered, covered * reflected, covered * (T(1) - reflected) * T(m.transmission)};
    }

    /// How a ray that comes through a medium meets a dielectric. A window is entered on both sides, and left again.
    [[nodiscard]] Interface<T> interface(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction,
                                         const Medium& through) const {
        if (m.surface == Surface::window)
            return {T(index_of(through.here()) / m.ior), cosine(hit, direction), through, true};
        const bool enters = dot(direction, hit.geometric_normal) < T(0);
        const auto surface = through.at_surface_of(static_cast<std::int32_t>(hit.surface), m.priority, enters);
        return {T(index_of(surface.before) / index_of(surface.after)), cosine(hit, direction), surface.beyond,
                surface.is_real()};
    }

    /// The share of the light that a dielectric reflects: without Fresnel all or nothing.
    [[nodiscard]] T reflectance(const Material<F>& m, const Interface<T>& at) const {
        const T reflected = dielectric_reflectance(at.cos_incident, at.eta);
        return m.fresnel || reflected >= T(1) ? reflected : T(0);
    }

    /// What a mirror or a conductor reflects.
    [[nodiscard]] F reflectance(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction) const {
        if (m.surface == Surface::mirror)
            return m.color;
        const T c = cosine(hit, direction);
        return m.color *
               by_band([c](auto eta, auto k) { return conductor_reflectance(decltype(eta)(c), eta, k); }, m.eta, m.k);
    }

    /// The refracted ray's part in a bounce.
    ///
    /// @param share  of the light that the ray carries
    [[nodiscard]] Bounce<T, F> refracted(const Hit<T>& hit, const Interface<T>& at, T share) const {
        return {Event::refract, color(hit) * grey<F>(double(share)), at.eta, at.beyond};
    }

    /// What is left of the light after a flight through a medium.
    [[nodiscard]] F transmittance(const Medium& through, T distance) const {
        if (through.here() < 0)
            return grey<F>(1);
        return beer(materials_[static_cast<std::size_t>(through.here())].absorption, distance);
    }

    /// What a place lies in: rays to both sides count the surfaces that they come out of. A sheet of water over a basin
    /// is found by the one of them that goes up.
    [[nodiscard]] Medium media_about(const Vec3<T>& place) const {
        Medium media;
        for (const T side : {T(1), T(-1)}) {
            const Vec3<T> direction = side * normalize(Vec3<T>(T(0.17), T(0.93), T(0.31)));
            std::vector<int> comes_out(materials_.size(), 0);
            std::vector<std::size_t> inside; // the innermost first
            Vec3<T> origin = place;
            Contacts<T> contacts;
            for (int crossed = 0; crossed < 1000; ++crossed) {
                const auto hit =
                    intersect(origin, direction, contacts.t_min(), std::numeric_limits<T>::infinity(), contacts);
                if (!hit)
                    break;
                const T slope = dot(direction, hit->geometric_normal);
                if (material(*hit).surface == Surface::dielectric) {
                    int& count = comes_out[hit->surface];
                    count += slope > T(0) ? 1 : -1;
                    if (count == 1)
                        inside.push_back(hit->surface);
                }
                contacts.leave(hit->primitive, slope, T(2) * hit->position_error, true,
                               contacts.is_here(hit->distance, slope));
                origin = hit->position;
            }
            for (auto i = inside.rbegin(); i != inside.rend(); ++i)
                if (const auto number = static_cast<std::int32_t>(*i); comes_out[*i] > 0 && !media.has(number))
                    media.enter(number, materials_[*i].priority);
        }
        return media;
    }

    /// Photons from within the box begin in the media about a place in it: for lamps.
    void begin_in_media(const Box<T>& box, const Vec3<T>& place) {
        if (const Medium media = media_about(place); media.here() != Medium::none)
            lamp_media_.emplace_back(box.padded(), media);
    }
    /// Of a photon at a lamp.
    [[nodiscard]] Medium medium_at(const Vec3<T>& place) const {
        for (const auto& [box, media] : lamp_media_)
            if (box.contains(place))
                return media;
        return {};
    }

private:
    /// Takes one of a mixture's ways by chance, in proportion to its share, so that its weight is 1.
    ///
    /// @param number  0 to 1
    [[nodiscard]] Bounce<T, F> scatter_mixture(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction,
                                               const Medium& through, T number) const {
        const Shares share = shares(m, hit, direction, through);
        T left = number - share.missed;
        if (left < T(0))
            return {Event::refract, grey<F>(1), T(1), through};
        if (m.surface == Surface::mirror || m.surface == Surface::conductor)
            return {Event::reflect, reflectance(m, hit, direction)};
        if (!m.passes_light())
            return {m.is_diffuse() ? Event::deposit : Event::absorb};
        const Interface<T> at = interface(m, hit, direction, through);
        if (!at.is_real)
            return {Event::pass, grey<F>(1), T(1), at.beyond};
        left -= share.reflected;
        if (left < T(0))
            return {Event::reflect, grey<F>(1)};
        left -= share.passed;
        if (left < T(0) || !m.is_diffuse())
            return m.surface == Surface::window ? Bounce<T, F>{Event::refract, color(hit), T(1), through}
                                                : refracted(hit, at, T(1));
        return {Event::deposit};
    }

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
                nearest = (std::min)(nearest_so_far(ray, nearest), wide_t<T>(ray.t_max));
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

    /// Two hits beyond each other by no more than this may touch.
    [[nodiscard]] static wide_t<T> nearest_so_far(const Ray<T>& ray, const wide_t<T>& distance) {
        return distance + flattest * contact_height(ray, distance);
    }
    static constexpr wide_t<T> flattest = 16; ///< flatter rays tell distances less well than counts here

    [[nodiscard]] static std::uint64_t primitive_of(std::size_t part, const Candidate<T>& candidate) {
        return std::uint64_t(part) << 32 | candidate.primitive;
    }

    /// A part's nearest hit of those that are not left out. Shapes that are no meshes have two at most that may be.
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
                        const T here = T(found->distance); // beyond it, which rounding may have put before it
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

    /// Whether a hit comes before the best one so far, on another part.
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

    /// Visits bounded parts as `Bvh::traverse` does leaves. A single one, a mesh perhaps with a tree of its own, needs
    /// no tree about it.
    template <class Visit>
    void visit_bounded(const Ray<T>& ray, const Visit& visit) const {
        if (bounded_.size() == 1)
            visit(bounded_.front(), ray.t_max);
        else
            bvh_.traverse(ray,
                          [&](std::uint32_t leaf, T t_max) { return visit(bounded_[bvh_.leaf(leaf).front()], t_max); });
    }

    [[nodiscard]] double index_of(std::int32_t material) const {
        return material < 0 ? 1 : materials_[static_cast<std::size_t>(material)].ior;
    }

    /// Between the ray and the shading normal; where that one faces away, the geometric one.
    [[nodiscard]] static T cosine(const Hit<T>& hit, const Vec3<T>& direction) {
        const T geometric = dot(direction, hit.geometric_normal), shading = dot(direction, hit.shading_normal);
        const bool agree = (geometric > T(0)) == (shading > T(0));
        return (std::min)(abs(agree ? shading : geometric), T(1));
    }

    void require_materials(std::size_t i) const {
        const auto require = [&](std::size_t material) {
            if (material >= materials_.size())
                invalid_argument("Scene: part " + std::to_string(i) + " is made of material " +
                                 std::to_string(material) + ", which does not exist");
        };
        if (const auto* mesh = std::get_if<TriangleMesh<T>>(&parts_[i].shape))
            for (std::size_t triangle = 0; triangle < mesh->data().triangles.size(); ++triangle)
                require(mesh->material(triangle));
        else
            require(parts_[i].material);
    }

    void collect_specular(const Part& part, const Box<T>& box) {
        if (const auto* mesh = std::get_if<TriangleMesh<T>>(&part.shape)) {
            std::vector<bool> taken(mesh->data().positions.size());
            for (std::size_t i = 0; i < mesh->data().triangles.size(); ++i) {
                if (!materials_[mesh->material(i)].is_specular())
                    continue;
                has_specular_ = true;
                for (const std::uint32_t vertex : mesh->data().triangles[i]) {
                    if (!taken[vertex])
                        specular_points_.push_back(mesh->data().positions[vertex]);
                    taken[vertex] = true;
                }
            }
        } else if (materials_[part.material].is_specular()) {
            has_specular_ = true;
            for (int i = 0; i < 8 && box.is_finite(); ++i)
                specular_points_.push_back(box.corner(i));
        }
    }

    std::vector<Part> parts_;
    std::vector<Material<F>> materials_;
    std::vector<std::size_t> bounded_, unbounded_; ///< indices of parts
    Bvh<T> bvh_;                                   ///< over the bounded ones
    bool has_specular_ = false;
    std::vector<Vec3<T>> specular_points_;
    std::vector<std::pair<Box<T>, Medium>> lamp_media_; ///< of those lamps that are in any
};

} // namespace nephroid::examples
