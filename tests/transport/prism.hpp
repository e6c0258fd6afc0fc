// SPDX-License-Identifier: MIT
/// @file  A prism of two planes before a screen, and where it sends light: in closed form.
#pragma once

#include "nephroid/emission/spectrum/wavelength.hpp"
#include "transport/tiny_scenes.hpp"

#include <cmath>
#include <numbers>

namespace nephroid::tests {

/// Cauchy's glass: the index A + B/λ² and its slope, λ in nanometres.
struct Cauchy {
    double a = 1.73869, b = 15989; // of a flint like SF11

    [[nodiscard]] double index(double wavelength) const { return a + b / (wavelength * wavelength); }
    [[nodiscard]] double slope(double wavelength) const { return -2 * b / (wavelength * wavelength * wavelength); }
};

/// A prism with an apex angle of 60° at the origin and edges along z, whose first face looks along −x. Behind it
/// stands a screen, if there is one.
template <class T, class F = T>
struct Prism : SheetScene<T, F> {
    struct Answer {
        Event event = Event::absorb;
        F weight{};
        T eta{}, d_eta{};
    };
    static constexpr double apex = std::numbers::pi / 3;

    Cauchy glass;

    explicit Prism(const Cauchy& of_glass = {})
        : SheetScene<T, F>{{{{0, 0, 0}, {-1, 0, 0}, Event::refract},
                            {{0, 0, 0}, {T(std::cos(apex)), T(std::sin(apex)), 0}, Event::refract}}},
          glass(of_glass) {}

    /// Adds a screen across a direction, this far from the apex.
    void add_screen(const Vec<T>& direction, T distance) {
        this->sheets.push_back({distance * direction, -direction, Event::deposit});
    }

    template <class Sampler, class Light>
    [[nodiscard]] Answer scatter(const SurfaceHit<Vec<T>, Flat>& hit, const Vec<T>& direction, Sampler&,
                                 const Light& light) const {
        const auto& sheet = this->sheets[hit.surface];
        const double n = glass.index(light.wavelength), slope = glass.slope(light.wavelength);
        if (dot(direction, sheet.normal) < T(0))
            return {sheet.event, F(1), T(1 / n), T(-slope / (n * n))};
        return {sheet.event, F(1), T(n), T(slope)};
    }
};

/// Light through such a prism. The inclination to its principal section is kept by both faces; the projection onto the
/// section obeys Snell's law with Bravais's index sqrt(n² + (n² − 1) tan²γ).
struct ThroughPrism {
    double incident;    ///< in the section, on the first face, towards the apex
    double inclination; ///< γ
    Cauchy glass{};

    [[nodiscard]] double bravais(double wavelength) const {
        const double n = glass.index(wavelength), tan2 = square(std::tan(inclination));
        return std::sqrt(n * n + (n * n - 1) * tan2);
    }
    [[nodiscard]] double sine_out(double wavelength) const {
        const double n = bravais(wavelength);
        return n * std::sin(Prism<double>::apex - std::asin(std::sin(incident) / n));
    }
    /// The angle of the light in the section, from x towards y.
    [[nodiscard]] double angle(double wavelength) const {
        return Prism<double>::apex - std::asin(sine_out(wavelength));
    }
    /// ∂angle/∂λ = −sin A/(cos r₁ cos i₂) ∂n/∂λ
    [[nodiscard]] double angle_slope(double wavelength) const {
        const double n = bravais(wavelength), r1 = std::asin(std::sin(incident) / n);
        const double slope = glass.index(wavelength) * glass.slope(wavelength) / n / square(std::cos(inclination));
        return -std::sin(Prism<double>::apex) / (std::cos(r1) * std::cos(std::asin(sine_out(wavelength)))) * slope;
    }
    [[nodiscard]] Vec<double> direction_in() const { return direction_at(incident); }
    [[nodiscard]] Vec<double> direction_out(double wavelength) const { return direction_at(angle(wavelength)); }
    [[nodiscard]] Vec<double> d_direction_out(double wavelength) const {
        const double at = angle(wavelength), d = std::cos(inclination) * angle_slope(wavelength);
        return {-d * std::sin(at), d * std::cos(at), 0};
    }

private:
    [[nodiscard]] Vec<double> direction_at(double at) const {
        return {std::cos(inclination) * std::cos(at), std::cos(inclination) * std::sin(at), std::sin(inclination)};
    }
};

/// A photon with a wavelength.
template <class T, class F>
[[nodiscard]] auto of_wavelength(double wavelength, const Photon<Vec<T>, F>& photon) {
    using P = Wavelength<EqualBands<16>>;
    const Vec<T> zero{0, 0, 0};
    return ParametricPhoton<Vec<T>, F, 3, P>{photon.position,
                                             photon.direction,
                                             photon.flux,
                                             {photon.differential[0], photon.differential[1], {zero, zero}},
                                             P{wavelength, {}}};
}

} // namespace nephroid::tests
