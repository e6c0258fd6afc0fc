// SPDX-License-Identifier: MIT
/// @file  Materials of surfaces.
#pragma once

#include "common/ray.hpp"
#include "common/texture.hpp"

#include "nephroid/emission/flux.hpp"
#include "nephroid/vector/error.hpp"

#include <cmath>
#include <concepts>
#include <cstdint>
#include <memory>

namespace nephroid::examples {

/// Applies a function to each band of colours: numbers, or vectors of three.
template <class Function, std::floating_point... F>
[[nodiscard]] auto by_band(const Function& function, const F&... bands) {
    return function(bands...);
}

template <class Function, class T, class... Others>
[[nodiscard]] Vec3<T> by_band(const Function& function, const Vec3<T>& first, const Others&... others) {
    return {function(first.x, others.x...), function(first.y, others.y...), function(first.z, others.z...)};
}

/// A colour with the same number in each band.
template <Flux F>
[[nodiscard]] F grey(double value) {
    if constexpr (std::floating_point<F>)
        return static_cast<F>(value);
    else
        return F(static_cast<typename F::value_type>(value));
}

/// A colour from red, green and blue: one band is their mean.
template <Flux F>
[[nodiscard]] F color_from_rgb(const glm::vec3& rgb) {
    if constexpr (std::floating_point<F>)
        return static_cast<F>((rgb.x + rgb.y + rgb.z) / 3);
    else
        return F(rgb);
}

enum class Surface : unsigned char {
    diffuse,    ///< `color` is the albedo
    mirror,     ///< `color` is the reflectance, the same at each angle
    dielectric, ///< glass, water; `color` multiplies refracted light; uses `ior`, `fresnel`, `follow` and `absorption`
    window,     ///< both faces of a pane too thin to displace light; `color` multiplies transmitted light; uses `ior`
    conductor,  ///< metal of complex index `eta` + i `k`, times `color`
    black,      ///< absorbs all light; emitters do so too
};

/// Which of a dielectric's two rays photons take.
enum class Follow : unsigned char {
    both,       ///< one of them, by Fresnel's reflectance; without Fresnel terms, the refracted one if there is one
    refraction, ///< the refracted one alone; reflected light is absorbed
};

/// The textures of a material, on triangles that have texture coordinates.
struct MaterialTextures {
    struct Layer {
        std::shared_ptr<const Texture> texture; ///< null: there is none
        TextureReference reference;
    };

    Layer color;        ///< a factor of `Material::color`
    Layer transmission; ///< its red is a factor of `Material::transmission`
    Layer normal;       ///< a normal map
    double normal_scale = 1;
    bool has_opacity = false; ///< the opacity of `color` is a factor of `Material::coverage`
    double alpha_cutoff = 0;  ///< above 0: less coverage counts as 0, the rest as 1
};

/// In place of a wavelength: light of which the index is `Material::ior`.
inline constexpr double mean_light = 0;

struct RefractiveIndex {
    double value;
    double slope; ///< by the wavelength, 1/nm
};

template <Flux F>
struct Material {
    Surface surface = Surface::diffuse;
    F color = grey<F>(1);                ///< 0 to 1
    F emission = flux_traits<F>::zero(); ///< radiance seen on the side of the normal
    bool emits_on_both_sides = false;

    double ior = 1.5;      ///< of the inside, which the normal points away from
    double dispersion = 0; ///< 20 over the Abbe number, >= 0
    bool fresnel = true;   ///< whether the interface reflects; otherwise all light is refracted
    Follow follow = Follow::both;
    F absorption = flux_traits<F>::zero(); ///< of the inside, 1 / length: Beer's law
    std::int32_t priority = 0; ///< where insides overlap, the material with the highest priority fills the space

    F eta = grey<F>(1), k = flux_traits<F>::zero();

    /// Of a dielectric or window: the share of the entering light that is transmitted, 0 to 1. The rest falls on a
    /// diffuse layer with albedo `color`.
    double transmission = 1;
    double coverage = 1; ///< 0 to 1: the share of the area that the surface covers; light passes through the rest

    std::shared_ptr<const MaterialTextures> textures{}; ///< null: the same everywhere

    /// The index for light of a wavelength, nanometres, or for `mean_light`: Cauchy's formula through `ior` at the
    /// yellow helium line, with the Abbe number's difference between the hydrogen lines.
    /// Source: glTF 2.0, KHR_materials_dispersion.
    [[nodiscard]] RefractiveIndex index_at(double wavelength) const {
        if (dispersion == 0 || wavelength == mean_light)
            return {ior, 0};
        const double scale = (ior - 1) * dispersion / 20, inverse2 = 523655 / (wavelength * wavelength);
        const double n = ior + scale * (inverse2 - 1.5168);
        return n > 1 ? RefractiveIndex{n, -2 * scale * inverse2 / wavelength} : RefractiveIndex{1, 0};
    }

    [[nodiscard]] bool passes_light() const { return surface == Surface::dielectric || surface == Surface::window; }
    [[nodiscard]] bool is_specular() const {
        return passes_light() || surface == Surface::mirror || surface == Surface::conductor || lets_light_past();
    }
    /// Whether a part of it is diffuse.
    [[nodiscard]] bool is_diffuse() const {
        return (surface == Surface::diffuse || (passes_light() && is_partly_opaque())) && coverage > 0;
    }
    /// Whether it has parts that scatter light in different ways.
    [[nodiscard]] bool is_mixture() const { return lets_light_past() || (passes_light() && is_partly_opaque()); }
    /// Whether there are places that it does not cover, or covers in part.
    [[nodiscard]] bool lets_light_past() const { return coverage < 1 || (textures && textures->has_opacity); }
    /// Whether there are places that do not transmit all of the light that enters.
    [[nodiscard]] bool is_partly_opaque() const {
        return transmission < 1 || (textures && textures->transmission.texture);
    }
    [[nodiscard]] bool emits() const { return flux_traits<F>::power(emission) > 0; }

    [[nodiscard]] static Material diffuse(const F& albedo) { return with(Surface::diffuse, albedo); }
    [[nodiscard]] static Material mirror(const F& reflectance) { return with(Surface::mirror, reflectance); }
    [[nodiscard]] static Material black() { return with(Surface::black, flux_traits<F>::zero()); }

    [[nodiscard]] static Material emitter(const F& radiance, bool on_both_sides = false) {
        Material material = black();
        material.emission = radiance;
        material.emits_on_both_sides = on_both_sides;
        return material;
    }

    [[nodiscard]] static Material dielectric(double ior, bool fresnel = true, Follow follow = Follow::both) {
        if (!(ior > 0) || !std::isfinite(ior))
            invalid_argument("Material: an index of refraction must be positive and finite");
        Material material = with(Surface::dielectric, grey<F>(1));
        material.ior = ior;
        material.fresnel = fresnel;
        material.follow = follow;
        return material;
    }

    [[nodiscard]] static Material window(double ior) {
        Material material = dielectric(ior);
        material.surface = Surface::window;
        return material;
    }

    [[nodiscard]] static Material conductor(const F& eta, const F& k) {
        Material material = with(Surface::conductor, grey<F>(1));
        material.eta = eta;
        material.k = k;
        return material;
    }

private:
    [[nodiscard]] static Material with(Surface surface, const F& color) {
        Material material;
        material.surface = surface;
        material.color = color;
        return material;
    }
};

/// The absorption coefficient of a medium that transmits `color` (0 to 1 in each band) of the light over `distance` (>
/// 0). For black bands it is large but finite, so that a path of length 0 transmits all light.
template <Flux F>
[[nodiscard]] F absorption_from(const F& color, double distance) {
    return by_band(
        [distance](auto c) {
            using T = decltype(c);
            const T least = static_cast<T>(1e-30);
            return T(-std::log(c > least ? (c < T(1) ? c : T(1)) : least)) / T(distance);
        },
        color);
}

/// The transmittance over a distance by Beer's law, for each band.
template <Flux F, class T>
[[nodiscard]] F beer(const F& absorption, T distance) {
    return by_band([distance](auto a) { return decltype(a)(std::exp(-a * decltype(a)(distance))); }, absorption);
}

} // namespace nephroid::examples
