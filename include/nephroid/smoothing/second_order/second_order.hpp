// SPDX-License-Identifier: MIT
/// @file  Second-order splatting: each splat is shifted so that its bias cancels, and shaped by the photons around it.
///
/// For two emission coordinates (point, spot and directional lights) the shift of shifted_deposit.hpp is exact. For the
/// four of an area light the same shift is applied along the slice that a footprint follows (area_field.hpp). Photons
/// of lights that declare no domain are not shifted, and all get one smoothing (cross_validation.hpp).
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/second_order/light_fields.hpp"
#include "nephroid/smoothing/second_order/shifted_deposit.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

namespace nephroid::detail {

/// What became of a photon's footprint.
struct AppliedFootprint {
    bool shortened = false;    ///< whether its shift was
    bool as_published = false; ///< whether it counts as `Statistics::splatted_as_published`
};

/// Chooses the footprints of a pass's photons.
///
/// @tparam domains  the kinds of domains that the lights may have: only the code for these is compiled
template <Vector3 V, EmissionDomains domains = EmissionDomains{true, true, true}>
class SecondOrderFootprints {
public:
    using T = scalar_t<V>;
    using Options = SecondOrderOptions;

    /// @param pilot  photons emitted with smoothing 1, in the order of their indices
    template <Flux F, std::size_t N, class P, class E>
    SecondOrderFootprints(std::span<const TracedPhoton<V, F, N, P>> pilot, const Options& options, E& executor)
        : options_(options), fields_(PathSamples(pilot), options, TaskRunner(executor)) {}

    /// Whether the photon's light declares a domain, so that emission coordinates show which photons are neighbours.
    [[nodiscard]] static bool has_neighbours(const EmissionSample& sample) {
        return LightFields<domains>::has_neighbours(sample);
    }

    /// Sets the smoothing of photons without neighbours, for passes without a given smoothing. Without this call it is
    /// `default_smoothing`.
    void set_smoothing_without_neighbours(double smoothing) { smoothing_without_neighbours_ = smoothing; }

    /// From here on the footprints of a lamp with area are so many times as long and as wide as those chosen.
    ///
    /// @param size  0: its photons get the published footprints, and no shift
    void set_size(std::uint32_t lamp, double size) { sizes_[lamp] = size; }

    /// Gives a photon's deposit its footprint and shifts it.
    ///
    /// @param photon  emitted with smoothing 1; its deposit must not be empty
    /// @param second  if not null, gets the map's second derivatives (`shift_deposit`); 0 where they are not known
    template <Flux F, std::size_t N, class P>
    AppliedFootprint apply(TracedPhoton<V, F, N, P>& photon, std::array<Double3, 3>* second = nullptr) const {
        return apply(photon, size_of(photon.sample) > 0 ? chosen_by_field(photon) : std::nullopt, second);
    }

    /// What the field says of a photon, which takes the longest: for who needs it more than once.
    template <Flux F, std::size_t N, class P>
    [[nodiscard]] std::optional<FieldSample> chosen_by_field(const TracedPhoton<V, F, N, P>& photon) const {
        return photon.frame.is_regular() ? fields_.at(photon) : std::nullopt;
    }

    /// @param found  of chosen_by_field
    template <Flux F, std::size_t N, class P>
    AppliedFootprint apply(TracedPhoton<V, F, N, P>& photon, std::optional<FieldSample> found,
                           std::array<Double3, 3>* second = nullptr) const {
        Deposit<V, F, N>& deposit = *photon.deposit;
        if (const double size = size_of(photon.sample); size == 0)
            found.reset();
        else if (found && size != 1) {
            found->shape = size * size * found->shape;
            found->divergence = size * size * found->divergence;
        }
        if (!found || !(found->shape.determinant() > 0) || !std::isfinite(found->shape.trace())) {
            const double fallback = !has_neighbours(photon.sample)   ? smoothing_without_neighbours_
                                    : photon.sample.coordinates == 2 ? options_.policy.bounds.least
                                                                     : default_smoothing;
            scale_tangents(deposit, T(options_.smoothing.value_or(fallback)));
            if (second != nullptr)
                *second = {};
            return {.as_published =
                        has_neighbours(photon.sample) && photon.sample.coordinates != 2 && !options_.smoothing};
        }
        return {.shortened = shift_deposit(deposit, *found, options_.second_moment,
                                           {options_.policy.largest_shift, options_.largest_reach}, second),
                .as_published = found->as_published};
    }

private:
    [[nodiscard]] double size_of(const EmissionSample& sample) const {
        const auto found = sample.coordinates == 4 ? sizes_.find(sample.light) : sizes_.end();
        return found != sizes_.end() ? found->second : 1;
    }

    Options options_;
    double smoothing_without_neighbours_ = default_smoothing;
    LightFields<domains> fields_;
    std::map<std::uint32_t, double> sizes_; ///< of lamps with area
};

} // namespace nephroid::detail
