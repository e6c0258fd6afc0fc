// SPDX-License-Identifier: MIT
/// @file  A scene and its lamps in red, green and blue, seen by photons with a wavelength and a flux of bands.
#pragma once

#include "common/ray.hpp"
#include "common/scene.hpp"
#include "common/spectral_color.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/emission/without_tangents.hpp"

#include <cstddef>
#include <memory>
#include <utility>

namespace nephroid::examples {

/// Indices of refraction are those of the photon's wavelength, and colours are turned into bands. The reflectance of
/// glass, by which photons are split, is that of the photon's wavelength for all of its bands.
template <std::size_t B>
class SpectralView {
public:
    using T = float;
    using medium = Medium;
    using RgbScene = Scene<T, Vec3<T>>;

    struct Answer {
        Event event;
        Bands<T, B> weight;
        T eta;
        Medium medium;
        T d_eta;
    };

    /// Both are kept by reference.
    SpectralView(const RgbScene& scene, const SpectralColor<B>& colors) : scene_(&scene), colors_(&colors) {}

    template <class... Arguments>
        requires requires(const RgbScene& scene, const Arguments&... arguments) { scene.intersect(arguments...); }
    [[nodiscard]] auto intersect(const Arguments&... arguments) const { return scene_->intersect(arguments...); }

    template <class Sampler>
    [[nodiscard]] Answer scatter(const Hit<T>& hit, const Vec3<T>& direction, Sampler& sampler, const Medium& through,
                                 const Wavelength<EqualBands<B>>& light) const {
        const auto bounce = scene_->scatter_at(hit, direction, sampler, through, light.wavelength);
        return {bounce.event, colors_->bands_of(bounce.weight), bounce.eta, bounce.medium, bounce.d_eta};
    }

    [[nodiscard]] Bands<T, B> transmittance(const Medium& through, T distance) const {
        return colors_->bands_of(scene_->transmittance(through, distance));
    }
    [[nodiscard]] Medium medium_at(const Vec3<T>& position) const { return scene_->medium_at(position); }

private:
    const RgbScene* scene_;
    const SpectralColor<B>* colors_;
};

/// A lamp of red, green and blue that emits bands.
template <Light L, std::size_t B>
class InBands : public nephroid::detail::DomainLike<L> {
public:
    using vector = typename L::vector;
    using flux_type = Bands<float, B>;

    InBands(L light, std::shared_ptr<const SpectralColor<B>> colors)
        : light_(std::move(light)), colors_(std::move(colors)) {}

    template <class S>
    [[nodiscard]] Photon<vector, flux_type, emitted_t<L>::tangent_count> emit(S& samples,
                                                                              const Spread<float>& spread) const {
        const auto photon = light_.emit(samples, spread);
        return {photon.position, photon.direction, colors_->bands_of(photon.flux), photon.differential};
    }

    [[nodiscard]] EmissionDomain exact_domain() const requires nephroid::detail::DeclaresDomain<L> {
        return domain_of(light_);
    }
    template <class S>
        requires requires(const L& light, S& samples) { light.draw_coordinates(samples); }
    void draw_coordinates(S& samples) const { light_.draw_coordinates(samples); }

    [[nodiscard]] double power() const { return light_.power(); }

private:
    L light_;
    std::shared_ptr<const SpectralColor<B>> colors_;
};

} // namespace nephroid::examples
