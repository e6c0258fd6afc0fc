// SPDX-License-Identifier: MIT
/// @file  Several lights as one: photons are shared among them by power.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/vector/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid {

/// Lights of several types that emit the same photons. Itself a light.
///
/// A sample chooses the light, with probability p in proportion to its power; it then emits as one of N p photons, so
/// that fluxes and footprints are those that it would have with N p photons of its own. Draws one sample more than
/// the light chosen, first; with a single light none.
template <Light First, Light... Others>
    requires(std::same_as<typename First::vector, typename Others::vector>&&...)
&&(std::same_as<typename First::flux_type, typename Others::flux_type>&&...) class LightSet {
public:
    using vector = typename First::vector;
    using flux_type = typename First::flux_type;
    using T = scalar_t<vector>;
    static constexpr EmissionDomains domains = (emission_domains<First> | ... | emission_domains<Others>);
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
    [[nodiscard]] Photon<vector, flux_type> emit(S& samples, const Spread<T>& spread) const {
        if (lights_.size() == 1)
            return emit_from(0, samples, spread);
        const double place = samples.template next<double>() * total_power_;
        const auto found = std::upper_bound(power_up_to_.begin(), power_up_to_.end(), place);
        const bool is_dark = found == power_up_to_.end(); // all are: each photon is the first one's, without flux
        const std::size_t chosen = is_dark ? 0 : static_cast<std::size_t>(found - power_up_to_.begin());
        if constexpr (requires { samples.chose(chosen); })
            samples.chose(chosen);
        if (is_dark)
            return emit_from(0, samples, spread);
        const T probability = static_cast<T>(power_[chosen] / total_power_);
        return emit_from(chosen, samples, Spread<T>{spread.photons * probability, spread.smoothing});
    }

    /// The sum of the lights' powers.
    [[nodiscard]] double power() const { return total_power_; }

    [[nodiscard]] const std::vector<AnyLight>& lights() const { return lights_; }

private:
    template <class S>
    [[nodiscard]] Photon<vector, flux_type> emit_from(std::size_t i, S& samples, const Spread<T>& spread) const {
        return std::visit([&](const auto& light) { return light.emit(samples, spread); }, lights_[i]);
    }

    std::vector<AnyLight> lights_;
    std::vector<double> power_;
    std::vector<double> power_up_to_;
    double total_power_ = 0;
};

} // namespace nephroid
