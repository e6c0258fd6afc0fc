// SPDX-License-Identifier: MIT
/// @file  A light whose photons have a wavelength each, and a tangent by it.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/emission/spectrum/bands.hpp"
#include "nephroid/emission/spectrum/wavelength.hpp"
#include "nephroid/emission/target.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>

namespace nephroid {

namespace detail {
/// The domain of a light, with the wavelength as its last extra.
[[nodiscard]] constexpr EmissionDomain with_wavelength(EmissionDomain domain) {
    domain.extras[domain.extra_count()] = EmissionExtra::wavelength;
    return domain;
}

/// Declares the same emission domain as a light, and a wavelength.
template <class L>
struct SpectralDomain {
    static constexpr EmissionDomains domains = emission_domains<L>;
};
template <DeclaresDomain L>
    requires(L::domain.extra_count() < 2)
struct SpectralDomain<L> {
    static constexpr EmissionDomain domain = with_wavelength(L::domain);
};

/// A flux whose bands can be read and written one by one.
template <class F>
concept IndexesBands = requires(F flux, std::size_t band) {
    {double(flux[int(band)])};
    flux[int(band)] = flux[int(band)];
};

template <class L, class Spectrum>
consteval bool explain_spectral() {
    if constexpr (Light<L>)
        static_assert(IndexesBands<typename L::flux_type>,
                      "nephroid::Spectral: the flux of the light has no bands f[i] to read and write; nephroid::Bands "
                      "has them (emission/spectrum/bands.hpp)");
    else
        explain_light<L>();
    static_assert(DividesSpectrum<Spectrum>, "nephroid::Spectral: the spectrum lacks count, wavelength(coordinate) or "
                                             "coordinate(wavelength) (emission/spectrum/equal_bands.hpp)");
    return false;
}
/// A light and a spectrum for `Spectral`, or an error that says why not.
template <class L, class Spectrum>
concept MustMakeSpectral =
    (Light<L> && DividesSpectrum<Spectrum> && IndexesBands<typename L::flux_type>) || explain_spectral<L, Spectrum>();
} // namespace detail

/// Emits a light's photons, each with a wavelength drawn from a spectrum and with a tangent by it. A photon carries the
/// flux of all bands: passes splat each band where its tangent says that it lands (splat/spectral_splat.hpp).
///
/// The scene's `scatter` gets the wavelength as its last argument, and returns ∂η/∂λ as `d_eta`:
///
/// ```cpp
/// Answer scatter(const MyHit& hit, const Vec3& direction, auto& random, const auto& light) const {
///     const float index = glass.index(light.wavelength), slope = glass.slope(light.wavelength);
///     return entering ? Answer{Event::refract, weight, 1 / index, -slope / (index * index)}
///                     : Answer{Event::refract, weight, index, slope};
/// }
/// const nephroid::Spectral spectral(sun, nephroid::EqualBands<16>{400, 700}); // sun's flux: Bands<float, 16>
/// nephroid::caustics(scene, spectral, sums, {.count = 10'000});
/// ```
template <class L, class Spectrum>
    requires detail::MustMakeSpectral<L, Spectrum>
class Spectral : public detail::SpectralDomain<L> {
public:
    using vector = typename L::vector;
    using flux_type = typename L::flux_type;
    using T = scalar_t<vector>;
    static constexpr std::size_t tangents = emitted_t<L>::tangent_count + 1;
    using photon_type = ParametricPhoton<vector, flux_type, tangents, Wavelength<Spectrum, detail::parameters_t<L>>>;

    /// @param parts  equal parts of the spectrum, at least 1: a photon lights the bands of the part that its
    ///               wavelength is in, and is then brighter. A tangent predicts places to first order, so an error is
    ///               left that does not go away with more photons, but with more parts, as their square; noise grows
    ///               as their root
    /// Throws std::invalid_argument for a spectrum whose wavelengths are not positive or do not rise, and for no parts.
    Spectral(L light, Spectrum spectrum, std::size_t parts = 1)
        : light_(std::move(light)), spectrum_(std::move(spectrum)), parts_(parts) {
        const double shortest = spectrum_.wavelength(0), longest = spectrum_.wavelength(double(Spectrum::count));
        if (!(shortest > 0) || !(longest > shortest) || !std::isfinite(longest))
            invalid_argument("nephroid::Spectral: the spectrum goes from " + detail::text_of(shortest) + " to " +
                             detail::text_of(longest) + "; wavelengths must be positive, finite and rise");
        if (parts == 0)
            invalid_argument("nephroid::Spectral: parts is 0; the spectrum has at least 1 part");
    }

    template <SampleSource<T> S>
    [[nodiscard]] photon_type emit(S& samples, const Spread<T>& spread) const {
        const auto photon = light_.emit(samples, spread);
        const double at = double(samples.template next<T>()) * double(Spectrum::count);
        const Tangent<vector> none{zero_vector<vector>(), zero_vector<vector>()};
        const auto differential = [&]<std::size_t... I>(std::index_sequence<I...>) {
            return PhotonDifferential<vector, tangents>{photon.differential[I]..., none};
        }
        (std::make_index_sequence<tangents - 1>());
        photon_type emitted{
            photon.position, photon.direction, photon.flux, differential, {spectrum_.wavelength(at), spectrum_}};
        emitted.parameters.others = detail::parameters_of(photon);
        if (parts_ > 1) {
            const double width = double(Spectrum::count) / double(parts_), part = std::floor(at / width);
            emitted.parameters.shortest = spectrum_.wavelength(part * width);
            emitted.parameters.longest = spectrum_.wavelength((part + 1) * width);
        }
        return emitted;
    }

    [[nodiscard]] EmissionDomain exact_domain() const requires detail::DeclaresDomain<L> {
        return detail::with_wavelength(domain_of(light_));
    }
    /// Draws the light's coordinates, without emitting a photon.
    template <class S>
        requires requires(const L& light, S& samples) { light.draw_coordinates(samples); }
    void draw_coordinates(S& samples) const { light_.draw_coordinates(samples); }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] Spectral aimed_at(const BoundingSphere<vector>& target) const requires AimsAt<L, vector> {
        return {light_.aimed_at(target), spectrum_, parts_};
    }

    [[nodiscard]] double power() const { return double(light_.power()); }
    [[nodiscard]] const L& light() const { return light_; }
    [[nodiscard]] const Spectrum& spectrum() const { return spectrum_; }

private:
    L light_;
    Spectrum spectrum_;
    std::size_t parts_;
};

} // namespace nephroid
