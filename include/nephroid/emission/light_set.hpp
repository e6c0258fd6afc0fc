// SPDX-License-Identifier: MIT
/// @file  A set of lights as one light: photons are divided among them in proportion to their power.
#pragma once

#include "nephroid/emission/emission_sample.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/emission/target.hpp"
#include "nephroid/vector/error.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid {

namespace detail {
template <class First, class... Others>
concept SameVectorAndFlux = (std::same_as<typename First::vector, typename Others::vector> && ...) &&
                            (std::same_as<typename First::flux_type, typename Others::flux_type> && ...);

template <class First, class... Others>
concept SamePhotons = SameVectorAndFlux<First, Others...> &&(std::same_as<emitted_t<First>, emitted_t<Others>>&&...);

template <class First, class... Others>
consteval bool explain_set() {
    if constexpr (!Light<First>)
        explain_light<First>();
    (void)(... && (Light<Others> || explain_light<Others>()));
    if constexpr ((Light<First> && ... && Light<Others>)) {
        constexpr bool same_flux = SameVectorAndFlux<First, Others...>;
        static_assert(same_flux, "nephroid::LightSet: all lights of one set need the same `vector` and `flux_type`");
        static_assert(!same_flux || SamePhotons<First, Others...>,
                      "nephroid::LightSet: the photons of all lights of one set need the same number of tangents");
    }
    return false;
}

/// For lights that make one set, or an error that says why not.
template <class First, class... Others>
concept MustMakeSet = ((Light<First> && ... && Light<Others>)&&SamePhotons<First, Others...> &&
                       (MustDeclareDomain<First> && ... && MustDeclareDomain<Others>)) ||
                      explain_set<First, Others...>();
} // namespace detail

/// Lights of several types that emit photons of the same type. Itself a light.
///
/// The first sample chooses a light, with a probability p in proportion to its power; a set of one light does not draw
/// it. The chosen light then emits one of N p photons, so fluxes and footprints are as if it emitted N p photons by
/// itself. Each light keeps its own domain and extras.
template <class First, class... Others>
    requires detail::MustMakeSet<First, Others...>
class LightSet {
public:
    using vector = typename First::vector;
    using flux_type = typename First::flux_type;
    using photon_type = emitted_t<First>;
    using T = scalar_t<vector>;
    static constexpr detail::EmissionDomains domains =
        (detail::emission_domains<First> | ... | detail::emission_domains<Others>);
    using AnyLight = std::variant<First, Others...>;

    /// Throws std::invalid_argument for no lights, and for a power that is negative or not finite.
    explicit LightSet(std::vector<AnyLight> lights) : lights_(std::move(lights)) {
        if (lights_.empty())
            invalid_argument("nephroid::LightSet: no lights; pass at least one");
        for (const AnyLight& light : lights_) {
            const double power = std::visit([](const auto& l) { return double(l.power()); }, light);
            if (!(power >= 0) || !std::isfinite(power))
                invalid_argument("nephroid::LightSet: light " + std::to_string(power_.size()) + " has power " +
                                 std::to_string(power) + "; it must be finite and not negative");
            total_power_ += power;
            power_.push_back(power);
        }
        double sum = 0;
        for (const double power : power_) {
            sum += power;
            power_up_to_.push_back(sum);
        }
    }

    template <SampleSource<T> S>
        requires SampleSource<S, double>
    [[nodiscard]] photon_type emit(S& samples, const Spread<T>& spread) const {
        const Choice choice = choose(samples);
        const Spread<T> own{spread.photons * choice.probability, spread.smoothing};
        return std::visit(
            [&](const auto& light) {
                report_choice(samples, choice.light, light);
                return light.emit(samples, own);
            },
            lights_[choice.light]);
    }

    /// Draws the sample of the choice and the chosen light's coordinates, without emitting a photon.
    template <class S>
    void draw_coordinates(S& samples) const {
        const std::size_t chosen = choose(samples).light;
        std::visit(
            [&](const auto& light) {
                report_choice(samples, chosen, light);
                detail::draw_coordinates(light, samples);
            },
            lights_[chosen]);
    }

    /// The same lights, all aimed at what lies within a sphere.
    [[nodiscard]] LightSet aimed_at(const BoundingSphere<vector>& target) const
        requires(AimsAt<First, vector>&&...&& AimsAt<Others, vector>) {
        std::vector<AnyLight> aimed;
        for (const AnyLight& light : lights_)
            std::visit([&](const auto& one) { aimed.push_back(one.aimed_at(target)); }, light);
        return LightSet(std::move(aimed));
    }

    /// The sum of the lights' powers.
    [[nodiscard]] double power() const { return total_power_; }

    [[nodiscard]] const std::vector<AnyLight>& lights() const { return lights_; }

private:
    struct Choice {
        std::size_t light;
        T probability;
    };

    template <class S>
    [[nodiscard]] Choice choose(S& samples) const {
        if (lights_.size() == 1)
            return {0, T(1)};
        const double at = samples.template next<double>() * total_power_;
        const auto found = std::upper_bound(power_up_to_.begin(), power_up_to_.end(), at);
        if (found == power_up_to_.end()) // all powers are zero: the first light emits photons without flux
            return {0, T(1)};
        const auto chosen = static_cast<std::size_t>(found - power_up_to_.begin());
        return {chosen, static_cast<T>(power_[chosen] / total_power_)};
    }

    /// Tells the source which light was chosen, if the source records that (RecordingSource).
    template <class S, class L>
    static void report_choice(S& samples, std::size_t i, const L&) {
        if constexpr (requires { samples.chose(i, coordinates_of<L>); })
            samples.chose(i, coordinates_of<L>);
    }

    std::vector<AnyLight> lights_;
    std::vector<double> power_;
    std::vector<double> power_up_to_;
    double total_power_ = 0;
};

} // namespace nephroid
