// SPDX-License-Identifier: MIT
/// @file  A scene for the library's walk: parts, their materials, and the media that lamps stand in.
#pragma once

#include "common/surface_scattering.hpp"

#include "nephroid/emission/target.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/vector/error.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples {

/// Shapes and materials.
///
/// @tparam T  float or double
/// @tparam F  flux: T, or `glm::vec<3, T>` for red, green and blue
template <class T, Flux F = Vec3<T>>
class Scene : public SurfaceScattering<T, F> {
public:
    using vector = Vec3<T>;
    using flux_type = F;
    using medium = Medium;
    using typename Parts<T>::Part;

    Scene() = default;

    /// Throws std::invalid_argument for a material that does not exist.
    Scene(std::vector<Part> parts, std::vector<Material<F>> materials)
        : SurfaceScattering<T, F>(std::move(parts), std::move(materials)) {
        for (std::size_t i = 0; i < this->parts().size(); ++i) {
            require_materials(i);
            collect_specular(this->parts()[i]);
        }
    }

    /// Whether anything can make a caustic.
    [[nodiscard]] bool has_specular() const { return has_specular_; }

    /// Points whose convex hull contains all bounded specular surfaces, for `smallest_beam_over` and `bounding_sphere`:
    /// vertices of meshes, and corners of the boxes of other shapes. Empty if there are none.
    [[nodiscard]] const std::vector<Vec3<T>>& specular_points() const { return specular_points_; }

    /// Nothing if no bounded surface is specular.
    [[nodiscard]] std::optional<BoundingSphere<Vec3<T>>> specular_bounds() const {
        if (specular_points_.empty())
            return std::nullopt;
        return bounding_sphere(specular_points_);
    }

    [[nodiscard]] std::optional<Hit<T>> intersect(const Vec3<T>& origin, const Vec3<T>& direction, T t_min,
                                                  T t_max) const {
        auto hit = this->nearest_hit({origin, direction, t_min, t_max}, AnyOrder());
        if (this->has_normal_maps() && hit)
            this->apply_normal_map(*hit);
        return hit;
    }

    /// The same without the surfaces that the ray has just left. Surfaces that touch come in the order in which light
    /// passes them.
    [[nodiscard]] std::optional<Hit<T>> intersect(const Vec3<T>& origin, const Vec3<T>& direction, T t_min, T t_max,
                                                  const Contacts<T>& contacts) const {
        // First into the next glass, so that there is no air between two; then out of the last one; then the table.
        const auto rank = [this](std::size_t material, bool leaves) {
            const bool is_glass = this->materials()[material].surface == Surface::dielectric;
            return is_glass ? (leaves ? 1 : 0) : 2;
        };
        auto hit =
            this->nearest_hit({origin, direction, t_min, t_max}, ContactOrder<T, decltype(rank)>{contacts, rank});
        if (this->has_normal_maps() && hit)
            this->apply_normal_map(*hit);
        return hit;
    }

    /// The media around a point. Rays to both sides count the surfaces that they leave. The ray that goes up finds a
    /// sheet of water over a basin.
    [[nodiscard]] Medium media_about(const Vec3<T>& position) const {
        Medium media;
        for (const T side : {T(1), T(-1)}) {
            const Vec3<T> direction = side * normalize(Vec3<T>(T(0.17), T(0.93), T(0.31)));
            std::vector<int> left(this->materials().size(), 0);
            std::vector<std::size_t> inside; // the innermost first
            Vec3<T> origin = position;
            Contacts<T> contacts;
            for (int crossed = 0; crossed < 1000; ++crossed) {
                const auto hit =
                    intersect(origin, direction, contacts.t_min(), std::numeric_limits<T>::infinity(), contacts);
                if (!hit)
                    break;
                const T slope = dot(direction, hit->geometric_normal);
                if (this->material(*hit).surface == Surface::dielectric) {
                    int& count = left[hit->surface];
                    count += slope > T(0) ? 1 : -1;
                    if (count == 1)
                        inside.push_back(hit->surface);
                }
                contacts.leave(hit->primitive, slope, T(2) * hit->position_error, true,
                               contacts.is_here(hit->distance, slope));
                origin = hit->position;
            }
            for (auto i = inside.rbegin(); i != inside.rend(); ++i)
                if (const auto number = static_cast<std::int32_t>(*i); left[*i] > 0 && !media.has(number))
                    media.enter(number, this->materials()[*i].priority);
        }
        return media;
    }

    /// Lets photons of a lamp start in the media around it.
    ///
    /// @param box       of the lamp
    /// @param position  a point of the lamp
    void begin_in_media(const Box<T>& box, const Vec3<T>& position) {
        if (const Medium media = media_about(position); media.here() != Medium::none)
            lamp_media_.emplace_back(box.padded(), media);
    }
    /// The media of a photon that starts at a lamp.
    [[nodiscard]] Medium medium_at(const Vec3<T>& position) const {
        for (const auto& [box, media] : lamp_media_)
            if (box.contains(position))
                return media;
        return {};
    }

private:
    void require_materials(std::size_t i) const {
        const auto require = [&](std::size_t material) {
            if (material >= this->materials().size())
                invalid_argument("Scene: part " + std::to_string(i) + " is made of material " +
                                 std::to_string(material) + ", which does not exist");
        };
        if (const auto* mesh = std::get_if<TriangleMesh<T>>(&this->parts()[i].shape))
            for (std::size_t triangle = 0; triangle < mesh->data().triangles.size(); ++triangle)
                require(mesh->material(triangle));
        else
            require(this->parts()[i].material);
    }

    void collect_specular(const Part& part) {
        if (const auto* mesh = std::get_if<TriangleMesh<T>>(&part.shape)) {
            std::vector<bool> taken(mesh->data().positions.size());
            for (std::size_t i = 0; i < mesh->data().triangles.size(); ++i) {
                if (!this->materials()[mesh->material(i)].is_specular())
                    continue;
                has_specular_ = true;
                for (const std::uint32_t vertex : mesh->data().triangles[i]) {
                    if (!taken[vertex])
                        specular_points_.push_back(mesh->data().positions[vertex]);
                    taken[vertex] = true;
                }
            }
        } else if (this->materials()[part.material].is_specular()) {
            has_specular_ = true;
            const Box<T> box = this->bounds_of(part);
            for (int i = 0; i < 8 && box.is_finite(); ++i)
                specular_points_.push_back(box.corner(i));
        }
    }

    bool has_specular_ = false;
    std::vector<Vec3<T>> specular_points_;
    std::vector<std::pair<Box<T>, Medium>> lamp_media_; ///< of the lamps that are not in air
};

} // namespace nephroid::examples
