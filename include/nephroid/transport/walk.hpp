// SPDX-License-Identifier: MIT
/// @file  A photon's walk: from the lamp through mirrors and glass to the surface where its light is seen.
#pragma once

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"
#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/transport/trail.hpp"
#include "nephroid/vector/in_place.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace nephroid {

/// A photon where it is splatted: it has met at least one specular surface and now lies on a diffuse one.
template <Vector3 V, Flux F, std::size_t N = 2>
struct Deposit {
    V position;
    V normal;    ///< geometric, unit, on the side that the photon came from
    V direction; ///< of flight, unit
    F flux;
    std::array<V, N> d_position; ///< in the tangent plane
};

/// Bounds on a path.
struct WalkLimits {
    unsigned specular_events = 64; ///< reflections and refractions before the photon is terminated
    unsigned roulette_after = 8;   ///< specular events before Russian roulette sets in; it kills a photon with the
                                   ///< probability that its flux has fallen to, and the survivors carry on for it
};

namespace detail {

/// Nothing is flown through: what a scene without absorption carries.
struct NoMedium {};

template <class S, class V>
struct medium_of {
    using type = NoMedium;
};
template <class S, class V>
    requires Absorbs<S, V>
struct medium_of<S, V> {
    using type = typename S::medium;
};

/// One photon's walk, step by step. A step that ends the photon books its flux and returns false.
template <class S, Vector3 V, Flux F, std::size_t N>
class Walk {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;

    Walk(const S& scene, Photon<V, F, N>& photon, Statistics& account)
        : scene_(scene), account_(account), photon_(photon), emitted_power_(power(photon.flux)) {}

    [[nodiscard]] bool start() {
        ++account_.emitted.photons;
        if (emitted_power_ > 0 && isfinite(emitted_power_)) {
            account_.emitted.add(emitted_power_);
            return true;
        }
        // A light may emit nothing in a direction; what is no number at all has no place in a sum.
        account_.end(emitted_power_ == 0 ? Fate::absorbed : Fate::invalid, 0);
        return false;
    }

    /// Carries the photon and its tangents to a hit.
    [[nodiscard]] bool fly_to(const H& hit) {
        const T distance = hit.distance;
        const auto flight = transfer(photon_.direction, distance + ahead_, V(hit.geometric_normal));
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
        if constexpr (Absorbs<S, V>)
            return weigh(scene_.transmittance(medium_, distance));
        else
            return true;
    }

    [[nodiscard]] Deposit<V, F, N> deposit(const H& hit) const {
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
            return Deposit<V, F, N>{photon_.position,
                                    facing(hit) * V(hit.geometric_normal),
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
        if (!isfinite(after))
            return end(Fate::invalid);
        account_.lose(Fate::absorbed, before - after);
        photon_.flux = weighted;
        return true;
    }

    /// Reflects or refracts the photon, about the geometric normal where the shading normal would send it through the
    /// wrong side.
    template <class Scattering>
    [[nodiscard]] bool bend(const H& hit, const Scattering& scattering) {
        const V geometric_normal = facing(hit) * V(hit.geometric_normal);
        V shading_normal = geometric_normal;
        if constexpr (HasShadingNormal<H, V>)
            shading_normal = facing(hit) * V(hit.shading_normal);
        if (!bend_about(shading_normal, geometric_normal, hit, scattering)) {
            ++account_.corrected_normals;
            if (!bend_about(geometric_normal, geometric_normal, hit, scattering))
                return end(Fate::invalid);
        }
        ++account_.specular_events;
        return true;
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

    /// Moves the origin of the next ray off the surface, to the side that it leaves on.
    void leave(const H& hit) {
        if constexpr (SpawnsRays<S, V>) {
            photon_.position = scene_.spawn(hit, photon_.direction);
        } else {
            // By twice the error: once for the point that was hit, once for the next intersection's own rounding. Along
            // the ray, which so stays on its line, and only for what is left at low angles along the normal.
            const V normal = hit.geometric_normal;
            const T cosine = dot(photon_.direction, normal), steepness = abs(cosine),
                    height = T(2) * T(hit.position_error);
            const T along = steepness > T(0.5) ? height / steepness : T(2) * height;
            const T rest = (std::max)(T(0), height - along * steepness);
            photon_.position = photon_.position + (along * photon_.direction + (cosine > T(0) ? rest : -rest) * normal);
            ahead_ = along + rest * steepness;
        }
    }

    bool end(Fate fate) {
        account_.end(fate, power(photon_.flux));
        return false;
    }

    [[nodiscard]] const Photon<V, F, N>& photon() const { return photon_; }

    /// Whether the photon flies against the hit's geometric normal.
    [[nodiscard]] bool is_in_front_of(const H& hit) const {
        return dot(photon_.direction, V(hit.geometric_normal)) < T(0);
    }

private:
    [[nodiscard]] static double power(const F& flux) { return double(flux_traits<F>::power(flux)); }

    /// +1 or −1: what turns the hit's normals, and the change of the shading one, to face the photon.
    [[nodiscard]] T facing(const H& hit) const {
        return dot(photon_.direction, V(hit.geometric_normal)) > T(0) ? T(-1) : T(1);
    }

    template <class Scattering>
    [[nodiscard]] bool bend_about(const V& normal, const V& geometric_normal, const H& hit,
                                  const Scattering& scattering) {
        if (scattering.event == Event::refract) {
            if constexpr (!refracts<Scattering>) {
                return false; // it said that it never would
            } else if (const auto refracted = refraction(photon_.direction, normal, T(scattering.eta))) {
                if (!(dot(refracted->direction(), geometric_normal) < T(0)))
                    return false;
                follow(*refracted, normal, hit, scattering);
                if constexpr (requires { medium_ = scattering.medium; })
                    medium_ = scattering.medium;
                return true;
            }
        }
        const Reflection<V> reflected(photon_.direction, normal);
        if (!(dot(photon_.direction, normal) < T(0)) || !(dot(reflected.direction(), geometric_normal) > T(0)))
            return false;
        follow(reflected, normal, hit, scattering);
        return true;
    }

    /// @param turn  a Reflection or a Refraction
    template <class Turn, class Scattering>
    void follow(const Turn& turn, const V& normal, const H& hit, const Scattering& scattering) {
        const T side = facing(hit);
        for (std::size_t i = 0; i < N; ++i) {
            Tangent<V>& tangent = photon_.differential[i];
            const V d_shading = side * V(hit.curvature(tangent.d_position));
            const V d_normal =
                d_shading - dot(normal, d_shading) * normal; // the normal in use may be the geometric one
            if constexpr (requires { turn.differentiate(d_normal, d_normal, T(scattering.d_eta[i])); })
                tangent.d_direction = turn.differentiate(tangent.d_direction, d_normal, T(scattering.d_eta[i]));
            else
                tangent.d_direction = turn.differentiate(tangent.d_direction, d_normal);
            bring_into_range(tangent);
        }
        photon_.direction = turn.direction();
    }

    const S& scene_;
    Statistics& account_;
    Photon<V, F, N>& photon_; // the caller's own: copied here, its first flight would wait for it
    double emitted_power_;
    T ahead_ = T(0); ///< how far ahead of the surface that the photon left its ray began
    [[no_unique_address]] typename medium_of<S, V>::type medium_{};
};

} // namespace detail

/// Follows one photon along its specular path.
///
/// @param scene    the renderer's, see `Scene`
/// @param photon   as emitted; used up
/// @param sampler  the photon's own stream of numbers, from which the scene and Russian roulette draw
/// @param limits   on the path
/// @param account  gets the photon's flux by reason, except for what is deposited: that is the caller's to book
/// @param trail    notes the surfaces met (transport/trail.hpp)
/// @return  the photon where it is to be splatted; nothing if it ended otherwise, which is then in the account.
/// Does not throw unless the scene does.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Trail = NoTrail>
    requires detail::MustBeScene<S, V, Sampler>
[[nodiscard]] std::optional<Deposit<V, F, N>> walk(const S& scene, Photon<V, F, N>&& photon, Sampler& sampler,
                                                   const WalkLimits& limits, Statistics& account, Trail&& trail = {}) {
    using T = scalar_t<V>;
    static_assert(
        Absorbs<S, V> || !requires { typename S::medium; },
        "nephroid::walk: the scene names a medium, but transmittance(medium, distance) is missing or not const");
    detail::Walk<S, V, F, N> path(scene, photon, account);
    const auto ended = [&](Fate fate) {
        path.end(fate);
        return std::nullopt;
    };
    if (!path.start())
        return std::nullopt;
    for (unsigned events = 0;; ++events) {
        const Photon<V, F, N>& now = path.photon();
        if (!all_finite(now.position) || !all_finite(now.direction))
            return ended(Fate::invalid);
        ++account.rays;
        const auto hit = scene.intersect(now.position, now.direction, T(0), std::numeric_limits<T>::infinity());
        if (!hit)
            return ended(Fate::escaped);
        if (!path.fly_to(*hit))
            return std::nullopt;

        const auto scattering = scene.scatter(*hit, now.direction, sampler);
        if (scattering.event == Event::absorb)
            return ended(Fate::absorbed);
        if (scattering.event == Event::deposit) {
            if (events == 0)
                return ended(Fate::direct);
            trail.meet(*hit, path.is_in_front_of(*hit), false);
            return std::optional<Deposit<V, F, N>>(std::in_place, InPlace{[&] { return path.deposit(*hit); }});
        }
        if (events == limits.specular_events)
            return ended(Fate::terminated);
        const bool from_front = path.is_in_front_of(*hit);
        if (!path.weigh(scattering.weight) || !path.bend(*hit, scattering))
            return std::nullopt;
        trail.meet(*hit, from_front, path.is_in_front_of(*hit) == from_front);
        if (events + 1 >= limits.roulette_after && !path.survives_roulette(sampler))
            return std::nullopt;
        path.leave(*hit);
    }
}

/// The same, for a photon that stays as it was.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Trail = NoTrail>
    requires detail::MustBeScene<S, V, Sampler>
[[nodiscard]] std::optional<Deposit<V, F, N>> walk(const S& scene, const Photon<V, F, N>& photon, Sampler& sampler,
                                                   const WalkLimits& limits, Statistics& account, Trail&& trail = {}) {
    Photon<V, F, N> walker = photon;
    return walk(scene, std::move(walker), sampler, limits, account, std::forward<Trail>(trail));
}

} // namespace nephroid
