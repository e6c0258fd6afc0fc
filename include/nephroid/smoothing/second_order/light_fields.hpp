// SPDX-License-Identifier: MIT
/// @file  Fields of footprints over the emission domains of several lights, one for each.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/smoothing/second_order/area_field.hpp"
#include "nephroid/smoothing/second_order/footprint_field.hpp"
#include "nephroid/smoothing/second_order/policies.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

namespace nephroid::detail {

struct SecondOrderOptions {
    SecondOrder policy{};
    std::optional<double> smoothing{};
    bool stratified = false;
    double second_moment = 0.125;                                   ///< of the kernel
    double photons = 0;                                             ///< emitted by the whole pass, N_e
    double largest_reach = std::numeric_limits<double>::infinity(); ///< of a footprint, world units
};

/// The fields of all lights that declare a domain.
///
/// @tparam domains  the kinds of domains that the lights may have: only the code for these is compiled
template <EmissionDomains domains>
class LightFields {
public:
    /// @param pilot  photons emitted with smoothing 1, in the order of their indices; each light gets a field made from
    ///               its own photons
    LightFields(const PathSamples& pilot, const SecondOrderOptions& options, const TaskRunner& run) {
        for (std::size_t i = 0; i < pilot.size(); ++i)
            if (has_neighbours(pilot[i].sample)) {
                const std::uint64_t origin = origin_of(pilot[i].sample);
                const auto at = std::lower_bound(origins_.begin(), origins_.end(), origin);
                if (at == origins_.end() || *at != origin)
                    origins_.insert(at, origin);
            }
        std::vector<PathSamples> by_light(origins_.size());
        for (std::size_t i = 0; i < pilot.size(); ++i)
            if (has_neighbours(pilot[i].sample))
                by_light[std::size_t(find(pilot[i].sample) - origins_.begin())].add(pilot[i]);
        fields_.reserve(by_light.size());
        for (const PathSamples& photons : by_light)
            add(photons, pilot.size(), options, run);
    }

    /// Whether the photon's light declares a domain, so that emission coordinates show which photons are neighbours.
    [[nodiscard]] static bool has_neighbours(const EmissionSample& sample) {
        return (domains.two && sample.coordinates == 2) || (domains.four && sample.coordinates == 4);
    }

    /// @return  nothing for lights without a domain or with too few photons
    [[nodiscard]] std::optional<FieldSample> at(const PathSample& photon) const {
        const auto found = find(photon.sample);
        if (found == origins_.end() || *found != origin_of(photon.sample))
            return std::nullopt;
        const Field& field = fields_[std::size_t(found - origins_.begin())];
        if constexpr (domains.two && domains.four)
            return std::visit([&](const auto& one) { return field_sample(one, photon); }, field);
        else
            return field_sample(field, photon);
    }

private:
    using OnlyField = std::conditional_t<domains.four, AreaField, FootprintField>;
    using Field = std::conditional_t<domains.two && domains.four, std::variant<FootprintField, AreaField>, OnlyField>;

    /// The index of a light, and the number of coordinates of its domain.
    [[nodiscard]] static std::uint64_t origin_of(const EmissionSample& sample) {
        return std::uint64_t(sample.light) << 32 | sample.coordinates;
    }

    [[nodiscard]] auto find(const EmissionSample& sample) const {
        return std::lower_bound(origins_.begin(), origins_.end(), origin_of(sample));
    }

    /// @param photons  of one light, at least one
    /// @param all      number of photons of all lights
    void add(const PathSamples& photons, std::size_t all, const SecondOrderOptions& options, const TaskRunner& run) {
        const double emitted = options.photons * double(photons.size()) / double(all);
        const FieldOptions field{.smoothing = options.smoothing,
                                 .stratified = options.stratified,
                                 .repeats = options.policy.domain_repeats,
                                 .scale = 0.125 / options.second_moment,
                                 .photons = emitted,
                                 .bounds = bounds_for(options.policy.bounds, emitted),
                                 .largest_miss = options.policy.largest_miss};
        if constexpr (domains.two)
            if (photons[0].sample.coordinates == 2)
                fields_.push_back(FootprintField(photons, field, run));
        if constexpr (domains.four)
            if (photons[0].sample.coordinates == 4)
                fields_.push_back(AreaField(photons, field, run));
    }

    [[nodiscard]] static std::optional<FieldSample> field_sample(const FootprintField& field,
                                                                 const PathSample& photon) {
        return field.at(photon.sample.at, photon.frame, photon.signature);
    }
    [[nodiscard]] static std::optional<FieldSample> field_sample(const AreaField& field, const PathSample& photon) {
        return field.at(photon.sample, photon.frame, photon.signature);
    }

    std::vector<std::uint64_t> origins_; ///< sorted
    std::vector<Field> fields_;          ///< of each
};

} // namespace nephroid::detail
