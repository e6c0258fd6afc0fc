// SPDX-License-Identifier: MIT
/// @file  The steps of a photon's walk: to a surface, off it again, and what each step changes in the photon and in the
///        account.
#pragma once

#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/transport/ray_start.hpp"
#include "nephroid/transport/turn.hpp"
#include "nephroid/transport/value_checks.hpp"

#include <cstddef>
#include <utility>

namespace nephroid::detail {

/// One photon's walk, step by step. A step that ends the photon books its flux and returns false.
template <class S, Vector3 V, Flux F, std::size_t N>
class PhotonSteps {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;
    using Medium = typename medium_of<S, V>::type;
    using Start = RayStart<S, V>;

    PhotonSteps(const S& scene, Photon<V, F, N>& photon, Statistics& account)
        : scene_(scene), account_(account), photon_(photon), emitted_power_(power(photon.flux)) {}

    [[nodiscard]] bool start() {
        ++account_.emitted.photons;
        if (emitted_power_ > 0 && isfinite(emitted_power_)) {
            account_.emitted.add(emitted_power_);
            if (!is_unit(photon_.direction) || has_negative_band(photon_.flux))
                return end(Fate::invalid);
            if constexpr (KnowsMediumOfLamps<S, V>)
                medium_ = scene_.medium_at(photon_.position);
            ray_start_.begin(scene_, photon_);
            return true;
        }
        // A light may emit nothing in a direction. A flux that is not finite is never added to a sum.
        account_.end(emitted_power_ == 0 ? Fate::absorbed : Fate::invalid, 0);
        return false;
    }

    /// The first surface on the photon's way.
    [[nodiscard]] auto next_hit() const { return ray_start_.next_hit(scene_, photon_); }

    /// Carries the photon and its tangents to a hit.
    [[nodiscard]] bool fly_to(const H& hit) {
        const V normal = hit.geometric_normal;
        const T distance = ray_start_.distance_to(hit, photon_.direction);
        if (!(distance >= T(0)) || !is_unit(normal))
            return end(Fate::invalid);
        const auto flight = transfer(photon_.direction, ray_start_.from_surface(distance), normal);
        if (!flight)
            return end(Fate::invalid);
        for (Tangent<V>& tangent : photon_.differential) {
            tangent.d_position = (*flight)(tangent).d_position; // its d_direction stays as it is
            bring_into_range(tangent);
        }
        if constexpr (HasPosition<H, V>)
            photon_.position = hit.position;
        else
            photon_.position = photon_.position + distance * photon_.direction;
        const T flown = (std::max)(distance - skipped_by_tracer<V>(scene_), T(0)); // less by rounding
        ray_start_.arrive(hit, photon_, flown);
        if constexpr (Absorbs<S, V>)
            return scale_flux(scene_.transmittance(medium_, flown));
        else
            return true;
    }

    [[nodiscard]] Deposit<V, F, N> deposit(const H& hit) const {
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
            return Deposit<V, F, N>{photon_.position,
                                    facing_normal(hit),
                                    photon_.direction,
                                    photon_.flux,
                                    {photon_.differential[I].d_position...}};
        }
        (std::make_index_sequence<N>());
    }

    /// Multiplies the flux, and books the loss as absorbed.
    template <class Weight>
    [[nodiscard]] bool scale_flux(const Weight& weight) {
        const F weighted = photon_.flux * weight;
        const double before = power(photon_.flux), after = power(weighted);
        if (!isfinite(after) || has_negative_band(weighted))
            return end(Fate::invalid);
        account_.lose(Fate::absorbed, before - after);
        photon_.flux = weighted;
        return true;
    }

    /// Reflects or refracts the photon, about the geometric normal where the shading normal would send it through the
    /// wrong side.
    template <class Scattering>
    [[nodiscard]] bool turn(const H& hit, const Scattering& scattering) {
        const V geometric_normal = facing_normal(hit);
        V shading_normal = geometric_normal;
        if constexpr (HasShadingNormal<H, V>)
            shading_normal = sign_of(hit) * V(hit.shading_normal);
        if (!is_unit(shading_normal) || !has_valid_index<T>(scattering))
            return end(Fate::invalid);
        if (!turn_about(photon_, medium_, shading_normal, geometric_normal, hit, scattering)) {
            ++account_.corrected_normals;
            if (!turn_about(photon_, medium_, geometric_normal, geometric_normal, hit, scattering))
                return end(Fate::invalid);
        }
        ++account_.specular_events;
        return true;
    }

    /// Enters the medium behind a surface that light does not notice.
    template <class Scattering>
    void enter_medium([[maybe_unused]] const Scattering& scattering) {
        if constexpr (requires { medium_ = scattering.medium; })
            medium_ = scattering.medium;
    }

    /// Russian roulette: the photon survives with a probability equal to its flux over the emitted one, and then gets
    /// the emitted flux back.
    template <class Sampler>
    [[nodiscard]] bool survives_roulette(Sampler& sampler) {
        const double survival = power(photon_.flux) / emitted_power_;
        if (!(survival > 0))
            return end(Fate::absorbed);
        if (survival >= 1)
            return true;
        const T boost = T(1 / survival);
        if (!isfinite(boost) || !(double(sampler.template next<T>()) < survival))
            return end(Fate::terminated);
        const F boosted = photon_.flux * boost;
        account_.lose(Fate::terminated, power(photon_.flux) - power(boosted));
        photon_.flux = boosted;
        return true;
    }

    /// Ends a photon that carries less than this share of what was emitted.
    [[nodiscard]] bool carries_enough(double least_share) {
        const double carried = power(photon_.flux);
        if (carried > 0 && carried >= least_share * emitted_power_)
            return true;
        return end(carried == 0 ? Fate::absorbed : Fate::terminated);
    }

    /// Begins the next ray, on the side of the surface that it leaves to.
    ///
    /// @param passed  whether the photon goes on through the surface
    void leave(const H& hit, bool passed) { ray_start_.leave(scene_, hit, passed, photon_); }

    /// Where the ray to this surface began, and which surfaces the next ray leaves out.
    [[nodiscard]] const Start& ray_start() const { return ray_start_; }
    /// Whether the hit has to be left out, see `RayStart::is_on_edge`.
    [[nodiscard]] bool is_on_edge(const H& hit) { return ray_start_.is_on_edge(hit, photon_.direction); }

    bool end(Fate fate) {
        account_.end(fate, power(photon_.flux));
        return false;
    }

    [[nodiscard]] const Photon<V, F, N>& photon() const { return photon_; }
    [[nodiscard]] const Medium& medium() const { return medium_; }
    /// Replaces the photon by another one on the same surface.
    void continue_as(const Photon<V, F, N>& photon, const Medium& medium) {
        photon_ = photon;
        medium_ = medium;
    }
    /// Replaces the photon by one on another surface, where a way was pending.
    void continue_as(const Photon<V, F, N>& photon, const Medium& medium, const Start& ray_start) {
        continue_as(photon, medium);
        ray_start_ = ray_start;
    }
    /// Sets the photon's flux; the caller books the difference.
    void set_flux(const F& flux) { photon_.flux = flux; }

    /// Whether the photon flies against the hit's geometric normal.
    [[nodiscard]] bool is_in_front_of(const H& hit) const {
        return dot(photon_.direction, V(hit.geometric_normal)) < T(0);
    }

    /// The geometric normal, on the side that the photon is on.
    [[nodiscard]] V facing_normal(const H& hit) const { return sign_of(hit) * V(hit.geometric_normal); }
    [[nodiscard]] static double power(const F& flux) { return double(flux_traits<F>::power(flux)); }

private:
    [[nodiscard]] T sign_of(const H& hit) const { return facing_sign(photon_.direction, hit); }

    const S& scene_;
    Statistics& account_;
    Photon<V, F, N>& photon_; // the caller's: a copy made here would delay the first flight
    double emitted_power_;
    Start ray_start_{};
    [[no_unique_address]] Medium medium_{};
};

} // namespace nephroid::detail
