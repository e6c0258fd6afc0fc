// SPDX-License-Identifier: MIT
/// @file  Second-order splatting: each splat is shifted so that its bias cancels, and shaped by the photons around it.
///
/// For two emission coordinates (point, spot and directional lights) the shift of shifted_deposit.hpp is exact. For the
/// four of an area light the same shift is applied along the slice that a footprint follows (area_field.hpp). Photons
/// of lights that declare no domain are not shifted, and all get one smoothing (cross_validation.hpp).
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/second_order/area_field.hpp"
#include "nephroid/smoothing/second_order/footprint_field.hpp"
#include "nephroid/smoothing/second_order/shifted_deposit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::detail {

/// Chooses the footprints of a pass's photons.
///
/// @tparam domains  the kinds of domains that the lights may have: only the code for these is compiled
template <Vector3 V, EmissionDomains domains = EmissionDomains{true, true, true}>
class SecondOrderFootprints {
public:
    using T = scalar_t<V>;

    struct Options {
        SecondOrder policy{};
        std::optional<double> smoothing{};
        bool stratified = false;
        double second_moment = 0.125;                                   ///< of the kernel
        double photons = 0;                                             ///< emitted by the whole pass, N_e
        double largest_reach = std::numeric_limits<double>::infinity(); ///< of a footprint, world units
    };

    /// @param pilot  photons emitted with smoothing 1, in the order of their indices; each light gets a field made from
    ///               its own photons
    template <Flux F, std::size_t N, class E>
    SecondOrderFootprints(std::span<const TracedPhoton<V, F, N>> pilot, const Options& options, E& executor)
        : options_(options) {
        struct PhotonsOfLight {
            Origin origin;
            std::span<const TracedPhoton<V, F, N>> all;
            std::vector<std::uint32_t> indices;
            [[nodiscard]] std::size_t size() const { return indices.size(); }
            [[nodiscard]] const TracedPhoton<V, F, N>& operator[](std::size_t i) const { return all[indices[i]]; }
        };
        std::vector<PhotonsOfLight> by_light; // sorted
        for (std::size_t i = 0; i < pilot.size(); ++i) {
            const Origin origin = origin_of(pilot[i].sample);
            if (!has_neighbours(pilot[i].sample))
                continue;
            auto found = std::lower_bound(by_light.begin(), by_light.end(), origin,
                                          [](const PhotonsOfLight& a, const Origin& o) { return a.origin < o; });
            if (found == by_light.end() || found->origin != origin)
                found = by_light.insert(found, {origin, pilot, {}});
            found->indices.push_back(std::uint32_t(i));
        }
        fields_.reserve(by_light.size());
        for (const PhotonsOfLight& photons : by_light) {
            const double emitted = options.photons * double(photons.size()) / double(pilot.size());
            const FieldOptions field{.smoothing = options.smoothing,
                                     .stratified = options.stratified,
                                     .repeats = options.policy.domain_repeats,
                                     .scale = 0.125 / options.second_moment,
                                     .photons = emitted,
                                     .bounds = bounds_for(options.policy.bounds, emitted)};
            if constexpr (domains.two)
                if (photons.origin.second == 2)
                    fields_.push_back({photons.origin, FootprintField(photons, field, executor)});
            if constexpr (domains.four)
                if (photons.origin.second == 4)
                    fields_.push_back({photons.origin, AreaField(photons, field, executor)});
        }
    }

    /// Whether the photon's light declares a domain, so that emission coordinates show which photons are neighbours.
    [[nodiscard]] static bool has_neighbours(const EmissionSample& sample) {
        return (domains.two && sample.coordinates == 2) || (domains.four && sample.coordinates == 4);
    }

    /// Sets the smoothing of photons without neighbours, for passes without a given smoothing. Without this call it is
    /// `default_smoothing`.
    void set_smoothing_without_neighbours(double smoothing) { smoothing_without_neighbours_ = smoothing; }

    /// Gives a photon's deposit its footprint and shifts it.
    ///
    /// @param photon  emitted with smoothing 1; its deposit must not be empty
    /// @param second  if not null, gets the map's second derivatives (`shift_deposit`); 0 where they are not known
    /// @return  whether the shift was shortened
    template <Flux F, std::size_t N>
    bool apply(TracedPhoton<V, F, N>& photon, std::array<Space3, 3>* second = nullptr) const {
        Deposit<V, F, N>& deposit = *photon.deposit;
        const std::optional<FieldSample> found = photon.frame.is_regular() ? field_at(photon) : std::nullopt;
        if (!found || !(found->shape.determinant() > 0) || !std::isfinite(found->shape.trace())) {
            const double fallback = !has_neighbours(photon.sample)   ? smoothing_without_neighbours_
                                    : photon.sample.coordinates == 2 ? options_.policy.bounds.least
                                                                     : default_smoothing;
            scale_tangents(deposit, T(options_.smoothing.value_or(fallback)));
            if (second != nullptr)
                *second = {};
            return false;
        }
        return shift_deposit(deposit, *found, options_.second_moment,
                             {options_.policy.largest_shift, options_.largest_reach}, second);
    }

private:
    /// The index of a light, and the number of coordinates of its domain.
    using Origin = std::pair<std::uint32_t, std::uint32_t>;
    [[nodiscard]] static Origin origin_of(const EmissionSample& sample) { return {sample.light, sample.coordinates}; }

    using OneField = std::conditional_t<domains.four, AreaField, FootprintField>;
    struct LightField {
        Origin origin;
        std::conditional_t<domains.two && domains.four, std::variant<FootprintField, AreaField>, std::variant<OneField>>
            field;
    };

    [[nodiscard]] static std::optional<FieldSample> field_sample(const FootprintField& field,
                                                                 const PathSample& photon) {
        return field.at(photon.sample.at, photon.frame, photon.signature);
    }
    [[nodiscard]] static std::optional<FieldSample> field_sample(const AreaField& field, const PathSample& photon) {
        return field.at(photon.sample, photon.frame, photon.signature);
    }

    /// @return  nothing for lights without a domain or with too few photons
    [[nodiscard]] std::optional<FieldSample> field_at(const PathSample& photon) const {
        const Origin origin = origin_of(photon.sample);
        const auto found = std::lower_bound(fields_.begin(), fields_.end(), origin,
                                            [](const LightField& a, const Origin& o) { return a.origin < o; });
        if (found == fields_.end() || found->origin != origin)
            return std::nullopt;
        return std::visit([&](const auto& field) { return field_sample(field, photon); }, found->field);
    }

    Options options_;
    double smoothing_without_neighbours_ = default_smoothing;
    std::vector<LightField> fields_; // sorted by light
};

} // namespace nephroid::detail
