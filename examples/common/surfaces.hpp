// SPDX-License-Identifier: MIT
/// @file  The parts of a scene and their materials, which textures change from point to point.
#pragma once

#include "common/material.hpp"
#include "common/normal_map.hpp"
#include "common/parts.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples {

/// @tparam T  float or double
/// @tparam F  flux: T, or `glm::vec<3, T>` for red, green and blue
template <class T, Flux F>
class Surfaces : public Parts<T> {
public:
    using typename Parts<T>::Part;

    Surfaces() = default;
    Surfaces(std::vector<Part> parts, std::vector<Material<F>> materials)
        : Parts<T>(std::move(parts)), materials_(std::move(materials)) {
        for (const Material<F>& material : materials_)
            has_normal_maps_ = has_normal_maps_ || (material.textures && material.textures->normal.texture);
    }

    [[nodiscard]] const std::vector<Material<F>>& materials() const { return materials_; }
    [[nodiscard]] const Material<F>& material(const Hit<T>& hit) const { return materials_[hit.surface]; }

    /// The material's colour at a hit, with its texture.
    [[nodiscard]] F color(const Hit<T>& hit) const {
        const Material<F>& m = material(hit);
        if (!m.textures || !m.textures->color.texture)
            return m.color;
        const auto& [texture, reference] = m.textures->color;
        return m.color * color_from_rgb<F>(glm::vec3(texture->color(coordinates(hit, reference))));
    }

    /// `Material::transmission` at a hit, with its texture.
    [[nodiscard]] double transmission(const Hit<T>& hit) const {
        const Material<F>& m = material(hit);
        if (!m.textures || !m.textures->transmission.texture)
            return m.transmission;
        const auto& [texture, reference] = m.textures->transmission;
        return m.transmission * texture->data(coordinates(hit, reference)).x;
    }

    /// `Material::coverage` at a hit, with the opacity of its texture.
    [[nodiscard]] double coverage(const Hit<T>& hit) const {
        const Material<F>& m = material(hit);
        if (!m.textures || !m.textures->has_opacity)
            return m.coverage;
        const auto& [texture, reference] = m.textures->color;
        const double opacity = m.coverage * texture->data(coordinates(hit, reference)).w;
        const double cutoff = m.textures->alpha_cutoff;
        return cutoff > 0 ? (opacity >= cutoff ? 1 : 0) : opacity;
    }

protected:
    [[nodiscard]] bool has_normal_maps() const { return has_normal_maps_; }

    /// Gives a hit the normal and the curvature of its material's normal map, if it has one.
    void apply_normal_map(Hit<T>& hit) const {
        if (const auto& textures = material(hit).textures; textures && textures->normal.texture)
            if (const auto* mesh = mesh_of(hit))
                bend_normal(*mesh, triangle_of(hit), *textures, hit);
    }

private:
    [[nodiscard]] const TriangleMesh<T>* mesh_of(const Hit<T>& hit) const {
        return std::get_if<TriangleMesh<T>>(&this->parts()[std::size_t(hit.primitive >> 32)].shape);
    }
    [[nodiscard]] static std::size_t triangle_of(const Hit<T>& hit) {
        return static_cast<std::uint32_t>(hit.primitive);
    }

    /// Where an image is looked up at a hit: at its corner, if the surface has no texture coordinates.
    [[nodiscard]] glm::dvec2 coordinates(const Hit<T>& hit, const TextureReference& reference) const {
        const auto* mesh = mesh_of(hit);
        if (!mesh || mesh->data().coordinates[reference.set].empty())
            return reference.transformed(glm::dvec2(0));
        return reference.transformed(TextureTriangle(*mesh, triangle_of(hit), reference.set).at(*mesh, hit.position));
    }

    std::vector<Material<F>> materials_;
    bool has_normal_maps_ = false;
};

} // namespace nephroid::examples
