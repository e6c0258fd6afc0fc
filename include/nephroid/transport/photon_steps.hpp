// SPDX-License-Identifier: MIT
/// @file  The steps of a photon's walk: to a surface, off it, and what each does to the photon and its account.
#pragma once

#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/bend.hpp"
#include "nephroid/transport/contacts.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/transport/ray_start.hpp"
#include "nephroid/transport/sound_values.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace nephroid::detail {

/// One photon's walk, step by step. A step that ends the photon books its flux and returns false.
template <class S, Vector3 V, Flux F, std::size_t N>
class PhotonSteps {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;
    using Medium = typename medium_of<S, V>::type;
    using Contact = typename contact_of<S, V>::type;
    static constexpr bool surfaces_may_touch = LetsSurfacesTouch<S, V>;
    static_assert(!surfaces_may_touch || !HasTracerEpsilon<S, V>,
                  "nephroid: a scene that takes Contacts must have no tracer_epsilon, but find what lies at its rays' "
                  "start (transport/contacts.hpp)");

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
            begin_ray(T(0));
            return true;
        }
        // A light may emit nothing in a direction; what is no number at all has no place in a sum.
        account_.end(emitted_power_ == 0 ? Fate::absorbed : Fate::invalid, 0);
        return false;
    }

    /// The first surface on the photon's way.
    [[nodiscard]] auto next_hit() const {
        constexpr T endless = std::numeric_limits<T>::infinity();
        if constexpr (surfaces_may_touch)
            return scene_.intersect(photon_.position, photon_.direction, contact_.surfaces.t_min(), endless,
                                    contact_.surfaces);
        else
            return scene_.intersect(photon_.position, photon_.direction, T(0), endless);
    }

    /// Carries the photon and its tangents to a hit.
    [[nodiscard]] bool fly_to(const H& hit) {
        T distance = hit.distance;
        const V normal = hit.geometric_normal;
        if constexpr (surfaces_may_touch) {
            begins_at_hit_ = contact_.surfaces.is_here(distance, dot(photon_.direction, normal));
            if (begins_at_hit_)
                distance = (std::max)(distance, T(0));
        }
        if (!(distance >= T(0)) || !is_unit(normal))
            return end(Fate::invalid);
        const auto flight = transfer(photon_.direction, distance + ahead_, normal);
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
        const T flown = distance - skipped_by_tracer<V>(scene_);
        if (!contact_.begins_on_surface())
            begins_at_hit_ = flown * abs(dot(photon_.direction, normal)) <= T(2) * ray_clearance(hit, photon_.position);
        if constexpr (Absorbs<S, V>)
            return weigh(scene_.transmittance(medium_, flown));
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

    /// Multiplies the flux; what that takes is absorbed.
    template <class Weight>
    [[nodiscard]] bool weigh(const Weight& weight) {
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
    [[nodiscard]] bool bend(const H& hit, const Scattering& scattering) {
        const V geometric_normal = facing_normal(hit);
        V shading_normal = geometric_normal;
        if constexpr (HasShadingNormal<H, V>)
            shading_normal = facing(hit) * V(hit.shading_normal);
        if (!is_unit(shading_normal) || !has_index<T>(scattering))
            return end(Fate::invalid);
        if (!bend_about(photon_, medium_, shading_normal, geometric_normal, hit, scattering)) {
            ++account_.corrected_normals;
            if (!bend_about(photon_, medium_, geometric_normal, geometric_normal, hit, scattering))
                return end(Fate::invalid);
        }
        ++account_.specular_events;
        return true;
    }

    /// Goes on through a surface that light does not notice.
    template <class Scattering>
    void pass(const H& hit, const Scattering& scattering) {
        if constexpr (requires { medium_ = scattering.medium; })
            medium_ = scattering.medium;
        leave(hit, true);
    }

    /// Ends the photon with the probability that its flux has fallen to; else it carries on for those that ended.
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

    /// Moves the origin of the next ray off the surface, to the side that it leaves on.
    ///
    /// @param passed  whether it goes on through the surface
    void leave(const H& hit, [[maybe_unused]] bool passed) {
        if constexpr (surfaces_may_touch) {
            contact_.surfaces.leave(hit.primitive, dot(photon_.direction, V(hit.geometric_normal)),
                                    ray_clearance(hit, photon_.position), passed, begins_at_hit_);
            if constexpr (requires { hit.surface; })
                contact_.left = std::uint64_t(hit.surface);
            begin_ray(T(0));
        } else if constexpr (SpawnsRays<S, V>) {
            photon_.position = scene_.spawn(hit, photon_.direction);
            begin_ray(T(0));
        } else {
            // Along the ray, which so stays on its line, and only for what is left at low angles along the normal.
            const V normal = hit.geometric_normal;
            const T cosine = dot(photon_.direction, normal), steepness = abs(cosine),
                    height = ray_clearance(hit, photon_.position);
            const T along = steepness > T(0.5) ? height / steepness : T(2) * height;
            const T rest = (std::max)(T(0), height - along * steepness);
            photon_.position = photon_.position + (along * photon_.direction + (cosine > T(0) ? rest : -rest) * normal);
            begin_ray(along + rest * steepness);
        }
    }

    /// Whether the surface that the photon is at is where its ray began, as far as numbers can tell.
    [[nodiscard]] bool began_here() const { return begins_at_hit_; }

    bool end(Fate fate) {
        account_.end(fate, power(photon_.flux));
        return false;
    }

    [[nodiscard]] const Photon<V, F, N>& photon() const { return photon_; }
    [[nodiscard]] const Medium& medium() const { return medium_; }
    /// From the surface that the photon left to a distance along its ray, which begins a little ahead.
    [[nodiscard]] T distance_from_surface(T distance) const { return distance + ahead_; }

    /// Goes on with another photon, on the surface where this one is.
    void become(const Photon<V, F, N>& photon, const Medium& medium) {
        photon_ = photon;
        medium_ = medium;
    }
    /// On another surface, where a way waited.
    void become(const Photon<V, F, N>& photon, const Medium& medium, const Contact& contact, bool begins_at_hit) {
        become(photon, medium);
        contact_ = contact;
        begins_at_hit_ = begins_at_hit;
    }
    [[nodiscard]] const Contact& contact() const { return contact_; }

    /// Whether the hit is a triangle beside the one that the photon left, of the same surface: it lies on their edge.
    [[nodiscard]] bool is_on_edge(const H& hit) {
        if constexpr (surfaces_may_touch && requires { hit.surface; }) {
            const T cosine = dot(photon_.direction, V(hit.geometric_normal));
            const bool is_beside = contact_.surfaces.is_here(hit.distance, cosine) &&
                                   std::uint64_t(hit.surface) == contact_.left &&
                                   (cosine > T(0)) == contact_.surfaces.leaves_along_normal();
            if (is_beside)
                contact_.surfaces.leave_beside(hit.primitive);
            return is_beside;
        } else {
            return false;
        }
    }
    /// The photon carries this much from here on: whoever calls this books the rest.
    void carry(const F& flux) { photon_.flux = flux; }

    /// Whether the photon flies against the hit's geometric normal.
    [[nodiscard]] bool is_in_front_of(const H& hit) const {
        return dot(photon_.direction, V(hit.geometric_normal)) < T(0);
    }

    /// The geometric normal, on the side that the photon is on.
    [[nodiscard]] V facing_normal(const H& hit) const { return facing(hit) * V(hit.geometric_normal); }
    [[nodiscard]] static double power(const F& flux) { return double(flux_traits<F>::power(flux)); }

private:
    /// @param ahead  how far along its line from the surface the photon was put
    void begin_ray(T ahead) {
        ahead_ = ahead;
        if constexpr (HasTracerEpsilon<S, V>) {
            photon_.position = photon_.position - skipped_by_tracer<V>(scene_) * photon_.direction;
            ahead_ = ahead_ - skipped_by_tracer<V>(scene_);
        }
    }

    [[nodiscard]] T facing(const H& hit) const { return facing_sign(photon_.direction, hit); }

    const S& scene_;
    Statistics& account_;
    Photon<V, F, N>& photon_; // the caller's own: copied here, its first flight would wait for it
    double emitted_power_;
    T ahead_ = T(0); ///< how far ahead of the surface that the photon left its ray began
    bool begins_at_hit_ = false;
    [[no_unique_address]] Contact contact_{};
    [[no_unique_address]] Medium medium_{};
};

} // namespace nephroid::detail
