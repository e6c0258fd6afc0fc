// SPDX-License-Identifier: MIT
/// @file  What a scene's surfaces do with light: reflection, refraction, absorption, and mixtures of these.
#pragma once

#include "common/fresnel.hpp"
#include "common/surfaces.hpp"

#include "nephroid/transport/media.hpp"
#include "nephroid/transport/scattering.hpp"
#include "nephroid/transport/ways.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace nephroid::examples {

/// The media that a ray flies through: the insides of materials, by their indices.
using Medium = Media;

/// The result of a scene's `scatter`.
template <class T, Flux F>
struct Bounce {
    Event event = Event::absorb;
    F weight = flux_traits<F>::zero();
    T eta = T(1);
    Medium medium = {}; ///< that a refracted ray enters
    T d_eta = T(0);     ///< ∂η/∂λ, for photons with a wavelength
};

/// How one ray meets a dielectric.
template <class T>
struct Interface {
    T eta;          ///< n₁/n₂ for this ray
    T cos_incident; ///< with the shading normal if that faces the ray, otherwise with the geometric one
    Medium beyond;  ///< the media of a refracted ray
    bool is_real;   ///< false if the same medium is on both sides, so that light does not notice the surface
    T d_eta = T(0); ///< ∂η/∂λ
};

/// How a scene's surfaces scatter light. A surface's inside is the side that its normal points away from. So a sheet of
/// water over a basin does not need to be closed: a ray that enters the water is in it until it leaves it, or ends.
/// Where insides overlap, the material of the highest priority fills the point; among equal ones, the one that the ray
/// entered last.
///
/// @tparam T  float or double
/// @tparam F  flux: T, or `glm::vec<3, T>` for red, green and blue
template <class T, Flux F>
class SurfaceScattering : public Surfaces<T, F> {
public:
    using Surfaces<T, F>::Surfaces;
    using Surfaces<T, F>::material;
    using Surfaces<T, F>::materials;
    using Surfaces<T, F>::color;

    /// For rays whose media are not known: they are taken to fly through air.
    template <class Sampler>
    [[nodiscard]] Bounce<T, F> scatter(const Hit<T>& hit, const Vec3<T>& direction, Sampler& sampler) const {
        return scatter(hit, direction, sampler, Medium{});
    }

    /// @param direction  of the photon's flight, unit
    /// @param sampler    one number is drawn if there is a choice: between a dielectric's reflection and refraction, if
    ///                   both are followed, and between the parts of a mixture
    /// @param through    the media that the photon arrives through
    template <class Sampler>
    [[nodiscard]] Bounce<T, F> scatter(const Hit<T>& hit, const Vec3<T>& direction, Sampler& sampler,
                                       const Medium& through) const {
        return scatter_at(hit, direction, sampler, through, mean_light);
    }

    /// @param wavelength  of the light, nanometres, or `mean_light`: then indices are those of `Material::ior`
    template <class Sampler>
    [[nodiscard]] Bounce<T, F> scatter_at(const Hit<T>& hit, const Vec3<T>& direction, Sampler& sampler,
                                          const Medium& through, double wavelength) const {
        const Material<F>& m = material(hit);
        if (m.is_mixture())
            return scatter_mixture(m, hit, direction, through, sampler.template next<T>(), wavelength);
        switch (m.surface) {
        case Surface::diffuse:
            return scattered(hit);
        case Surface::mirror:
        case Surface::conductor:
            return {Event::reflect, reflectance(m, hit, direction)};
        case Surface::dielectric:
            break;
        case Surface::window:
            return scatter_mixture(m, hit, direction, through, sampler.template next<T>(), wavelength);
        case Surface::black:
            return {Event::absorb};
        }

        const Interface<T> at = interface(m, hit, direction, through, wavelength);
        if (!at.is_real)
            return {Event::pass, grey<F>(1), T(1), at.beyond};
        const T reflected = reflectance(m, at);
        if (m.follow == Follow::refraction)
            return reflected < T(1) ? refracted(hit, at, T(1) - reflected) : Bounce<T, F>{};
        if (reflected >= T(1) || (reflected > T(0) && sampler.template next<T>() < reflected))
            return reflected_by(at, T(1));
        return refracted(hit, at, T(1));
    }

    /// All ways that light takes at a surface, each with its share. Nothing is drawn by chance, so that light sheets
    /// can compare the paths of neighbouring photons.
    ///
    /// @param direction  of the photon's flight, unit
    /// @param through    the media that the photon arrives through
    [[nodiscard]] Ways<Bounce<T, F>, 4> scatter_all(const Hit<T>& hit, const Vec3<T>& direction,
                                                    const Medium& through = Medium{}) const {
        const Material<F>& m = material(hit);
        if (m.is_mixture() || m.surface == Surface::window)
            return all_of_mixture(m, hit, direction, through);
        switch (m.surface) {
        case Surface::diffuse:
            return scattered(hit);
        case Surface::mirror:
        case Surface::conductor:
            return Bounce<T, F>{Event::reflect, reflectance(m, hit, direction)};
        case Surface::dielectric:
        case Surface::window:
            break;
        case Surface::black:
            return {};
        }
        const Interface<T> at = interface(m, hit, direction, through);
        if (!at.is_real)
            return Bounce<T, F>{Event::pass, grey<F>(1), T(1), at.beyond};
        const T reflected = reflectance(m, at);
        Ways<Bounce<T, F>, 4> ways;
        if (reflected < T(1))
            ways.add(refracted(hit, at, T(1) - reflected));
        if (reflected > T(0) && m.follow != Follow::refraction)
            ways.add(reflected_by(at, reflected));
        return ways;
    }

    /// The shares of the light that meets a surface. The rest is scattered diffusely or absorbed.
    struct Shares {
        T missed;    ///< passes straight through the part that the surface does not cover
        T reflected; ///< by a dielectric or a window
        T passed;    ///< refracted by a dielectric, or straight through a window
    };

    /// The shares at a mixture. Its rest is diffuse, or scattered as its surface says.
    [[nodiscard]] Shares shares(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction,
                                const Medium& through = Medium{}, double wavelength = mean_light) const {
        const T covered = T(this->coverage(hit));
        if (!m.passes_light())
            return {T(1) - covered, T(0), T(0)};
        T reflected = reflectance(m, interface(m, hit, direction, through, wavelength));
        if (m.surface == Surface::window) // the sum over all reflections between its two faces
            reflected = T(2) * reflected / (T(1) + reflected);
        return {T(1) - covered, covered * reflected, covered * (T(1) - reflected) * T(this->transmission(hit))};
    }

    /// How a ray in a medium meets a dielectric. A window is thin: a ray enters it from both sides, and leaves it
    /// again.
    [[nodiscard]] Interface<T> interface(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction,
                                         const Medium& through, double wavelength = mean_light) const {
        if (m.surface == Surface::window)
            return {T(index_of(through.here(), wavelength).value / m.ior), cosine(hit, direction), through, true};
        const bool enters = dot(direction, hit.geometric_normal) < T(0);
        const auto surface = through.at_surface_of(static_cast<std::int32_t>(hit.surface), m.priority, enters);
        const RefractiveIndex before = index_of(surface.before, wavelength),
                              after = index_of(surface.after, wavelength);
        return {T(before.value / after.value), cosine(hit, direction), surface.beyond, surface.is_real(),
                T((before.slope * after.value - before.value * after.slope) / (after.value * after.value))};
    }

    /// The share of the light that a dielectric reflects; without Fresnel terms, all or nothing.
    [[nodiscard]] T reflectance(const Material<F>& m, const Interface<T>& at) const {
        const T reflected = dielectric_reflectance(at.cos_incident, at.eta);
        return m.fresnel || reflected >= T(1) ? reflected : T(0);
    }

    /// The share of the light that a mirror or a conductor reflects, by band.
    [[nodiscard]] F reflectance(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction) const {
        if (m.surface == Surface::mirror)
            return color(hit);
        const T c = cosine(hit, direction);
        return color(hit) *
               by_band([c](auto eta, auto k) { return conductor_reflectance(decltype(eta)(c), eta, k); }, m.eta, m.k);
    }

    /// A refraction.
    ///
    /// @param share  of the light, carried by the refracted ray
    [[nodiscard]] Bounce<T, F> refracted(const Hit<T>& hit, const Interface<T>& at, T share) const {
        return {Event::refract, color(hit) * grey<F>(double(share)), at.eta, at.beyond, at.d_eta};
    }

    /// A reflection by a dielectric. It names the indices: photons with a wavelength note for which others it exists.
    ///
    /// @param share  of the light, carried by the reflected ray
    [[nodiscard]] Bounce<T, F> reflected_by(const Interface<T>& at, T share) const {
        return {Event::reflect, grey<F>(double(share)), at.eta, Medium{}, at.d_eta};
    }

    /// The share of the light that is left after a flight through a medium, by band.
    [[nodiscard]] F transmittance(const Medium& through, T distance) const {
        if (through.here() < 0)
            return grey<F>(1);
        return beer(materials()[static_cast<std::size_t>(through.here())].absorption, distance);
    }

private:
    /// All ways at a mixture. Light that its diffuse part receives ends there if it has other ways as well.
    [[nodiscard]] Ways<Bounce<T, F>, 4> all_of_mixture(const Material<F>& m, const Hit<T>& hit,
                                                       const Vec3<T>& direction, const Medium& through) const {
        const Shares share = shares(m, hit, direction, through);
        const T covered = T(1) - share.missed;
        Ways<Bounce<T, F>, 4> ways;
        const auto add = [&](const Bounce<T, F>& way, T part) {
            if (part > T(0))
                ways.add({way.event, way.weight * grey<F>(double(part)), way.eta, way.medium, way.d_eta});
        };
        const auto add_diffuse = [&](T part) {
            if (m.is_diffuse())
                add(part < T(1) ? Bounce<T, F>{Event::deposit, grey<F>(1)} : scattered(hit), part);
        };
        add({Event::refract, grey<F>(1), T(1), through}, share.missed);
        if (m.surface == Surface::mirror || m.surface == Surface::conductor) {
            add({Event::reflect, reflectance(m, hit, direction)}, covered);
        } else if (!m.passes_light()) {
            add_diffuse(covered);
        } else if (const Interface<T> at = interface(m, hit, direction, through); !at.is_real) {
            add({Event::pass, grey<F>(1), T(1), at.beyond}, covered);
        } else {
            const T rest = covered - share.reflected, passed = m.is_diffuse() ? share.passed : rest;
            add(m.surface == Surface::window ? Bounce<T, F>{Event::refract, color(hit), T(1), through}
                                             : refracted(hit, at, T(1)),
                passed);
            add(reflected_by(at, T(1)), share.reflected);
            add_diffuse(rest - passed);
        }
        return ways;
    }

    /// Chooses one of a mixture's ways in proportion to its share, so that its weight is 1.
    ///
    /// @param number  chooses the way, 0 to 1
    [[nodiscard]] Bounce<T, F> scatter_mixture(const Material<F>& m, const Hit<T>& hit, const Vec3<T>& direction,
                                               const Medium& through, T number, double wavelength) const {
        const Shares share = shares(m, hit, direction, through, wavelength);
        T left = number - share.missed;
        if (left < T(0))
            return {Event::refract, grey<F>(1), T(1), through};
        if (m.surface == Surface::mirror || m.surface == Surface::conductor)
            return {Event::reflect, reflectance(m, hit, direction)};
        if (!m.passes_light())
            return m.is_diffuse() ? scattered(hit) : Bounce<T, F>{};
        const Interface<T> at = interface(m, hit, direction, through, wavelength);
        if (!at.is_real)
            return {Event::pass, grey<F>(1), T(1), at.beyond};
        left -= share.reflected;
        if (left < T(0))
            return reflected_by(at, T(1));
        left -= share.passed;
        if (left < T(0) || !m.is_diffuse())
            return m.surface == Surface::window ? Bounce<T, F>{Event::refract, color(hit), T(1), through}
                                                : refracted(hit, at, T(1));
        return scattered(hit);
    }

    [[nodiscard]] Bounce<T, F> scattered(const Hit<T>& hit) const { return {Event::diffuse, color(hit)}; }

    [[nodiscard]] RefractiveIndex index_of(std::int32_t number, double wavelength) const {
        return number < 0 ? RefractiveIndex{1, 0} : materials()[static_cast<std::size_t>(number)].index_at(wavelength);
    }

    /// The cosine between the ray and the shading normal, or, if that faces away, the geometric normal.
    [[nodiscard]] static T cosine(const Hit<T>& hit, const Vec3<T>& direction) {
        const T geometric = dot(direction, hit.geometric_normal), shading = dot(direction, hit.shading_normal);
        const bool agree = (geometric > T(0)) == (shading > T(0));
        return (std::min)(abs(agree ? shading : geometric), T(1));
    }
};

} // namespace nephroid::examples
