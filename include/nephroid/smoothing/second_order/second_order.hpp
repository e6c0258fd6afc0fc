// SPDX-License-Identifier: MIT
/// @file  Second-order splatting: each splat's centre shifted so that its bias cancels, its footprint shaped by the
///        photons around it.
///
/// A splat of shape S (smoothing_rule.hpp) about the photon's place F is shifted by
///
///     D = m₂/2 (S_ab F_ab + (∂_a S_ab) F_b),
///
/// which leaves a bias of fourth order and costs nothing per pixel [include/nephroid/README.md, "The second-order
/// shift"].
///
/// For two emission coordinates (point, spot and directional lights) this is exact; for the four of an area light the
/// same shift does it, along the slice that a footprint follows (area_field.hpp). Photons of lights that declare no
/// domain are splatted as without it, with one smoothing for all (cross_validation.hpp).
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/second_order/area_field.hpp"
#include "nephroid/smoothing/second_order/footprint_field.hpp"

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

/// The photons of a pass, turned to footprints.
///
/// @tparam domains  what its lights may emit from: no more is compiled than these need
template <Vector3 V, EmissionDomains domains = EmissionDomains{true, true, true}>
class SecondOrderFootprints {
public:
    using T = scalar_t<V>;

    struct Options {
        SecondOrder policy{};
        std::optional<double> smoothing{};
        bool stratified = false;
        double second_moment = 0.125;                                   ///< of the kernel
        double photons = 0;                                             ///< emitted in all, N_e
        double largest_reach = std::numeric_limits<double>::infinity(); ///< of a footprint that is not bounded
    };

    /// @param pilot  photons emitted with smoothing 1, in the order of their indices; those of each light are put
    ///               together
    template <Flux F, std::size_t N, class E>
    SecondOrderFootprints(std::span<const TracedPhoton<V, F, N>> pilot, const Options& options, E& executor)
        : options_(options) {
        struct OfOneLight {
            Origin origin;
            std::span<const TracedPhoton<V, F, N>> all;
            std::vector<std::uint32_t> indices;
            [[nodiscard]] std::size_t size() const { return indices.size(); }
            [[nodiscard]] const TracedPhoton<V, F, N>& operator[](std::size_t i) const { return all[indices[i]]; }
        };
        std::vector<OfOneLight> by_light; // sorted
        for (std::size_t i = 0; i < pilot.size(); ++i) {
            const Origin origin = origin_of(pilot[i].sample);
            if (!has_cells(pilot[i].sample))
                continue;
            auto found = std::lower_bound(by_light.begin(), by_light.end(), origin,
                                          [](const OfOneLight& a, const Origin& o) { return a.origin < o; });
            if (found == by_light.end() || found->origin != origin)
                found = by_light.insert(found, {origin, pilot, {}});
            found->indices.push_back(std::uint32_t(i));
        }
        fields_.reserve(by_light.size());
        for (const OfOneLight& photons : by_light) {
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

    /// Whether its light declares a domain: then coordinates say which photons are neighbours.
    [[nodiscard]] static bool has_cells(const EmissionSample& sample) {
        return (domains.two && sample.coordinates == 2) || (domains.four && sample.coordinates == 4);
    }

    /// What photons get that have no cells, where no smoothing is given; `default_smoothing` unless called.
    void smooth_others(double smoothing) { others_ = smoothing; }

    /// Gives a deposit its footprint and its place.
    ///
    /// @param photon  emitted with smoothing 1; its deposit must not be empty
    /// @param second  if given, gets the map's second derivatives by the halves of the new tangents, along the surface;
    ///                as much shortened as the shift is, and 0 where they are not known
    /// @return  whether the shift was shortened
    template <Flux F, std::size_t N>
    bool apply(TracedPhoton<V, F, N>& photon, std::array<Space3, 3>* second = nullptr) const {
        Deposit<V, F, N>& deposit = *photon.deposit;
        const std::optional<FieldSample> found = photon.frame.is_regular() ? field_at(photon) : std::nullopt;
        const auto tangents = unit_tangents(deposit);
        if (!found || !(found->shape.determinant() > 0) || !std::isfinite(found->shape.trace())) {
            const double fallback = !has_cells(photon.sample)        ? others_
                                    : photon.sample.coordinates == 2 ? options_.policy.bounds.least
                                                                     : default_smoothing;
            scale(deposit, T(options_.smoothing.value_or(fallback)));
            if (second != nullptr)
                *second = {};
            return false;
        }

        const double factor = 0.5 * options_.second_moment;
        const Symmetric2& s = found->shape;
        Plane2 drift = factor * found->divergence;
        // |drift| at most a quarter of the footprint, by its own measure.
        const double size2 =
            (s.yy * drift.x * drift.x - 2 * s.xy * drift.x * drift.y + s.xx * drift.y * drift.y) / s.determinant();
        bool bounded = size2 > 1.0 / 16;
        if (bounded)
            drift = (0.25 / std::sqrt(size2)) * drift;
        const Space3 bend = along_surface(
            factor * (s.xx * found->second[0] + ((2 * s.xy) * found->second[1] + s.yy * found->second[2])),
            deposit.normal);

        // S = L Lᵀ, the new tangents are J L.
        const double l00 = std::sqrt(s.xx), l10 = s.xy / l00, l11 = std::sqrt(s.determinant()) / l00;
        const Space3 a = l00 * tangents[0] + l10 * tangents[1], b = l11 * tangents[1];
        const double reach = (std::min)(std::sqrt((std::max)(inner(a, a), inner(b, b))), options_.largest_reach);
        const double most = options_.policy.largest_shift * reach;
        const Space3 shift = bend + (drift.x * tangents[0] + drift.y * tangents[1]);
        const double distance = std::sqrt(inner(shift, shift));
        const double share = distance > most ? most / distance : 1;
        bounded = bounded || distance > most;
        if (second != nullptr) {
            *second = turned(found->second, {{l00, l10}, {0, l11}});
            for (Space3& h : *second)
                h = along_surface(share * h, deposit.normal);
        }

        // In the renderer's own scalar again, which may know derivatives: S and H are constants to those.
        const V d_u = deposit.d_position[0], d_v = deposit.d_position[1];
        scale(deposit, T(std::sqrt(std::sqrt(s.determinant())))); // tangents beyond the first two
        deposit.d_position[0] = T(l00) * d_u + T(l10) * d_v;
        deposit.d_position[1] = T(l11) * d_v;
        deposit.position =
            deposit.position + (T(0.5 * share * drift.x) * d_u + T(0.5 * share * drift.y) * d_v) + world(share * bend);
        return bounded;
    }

private:
    [[nodiscard]] static V world(const Space3& v) { return make_vector<V>(T(v.x), T(v.y), T(v.z)); }

    [[nodiscard]] static Space3 along_surface(const Space3& v, const V& normal) {
        using t = vector_traits<V>;
        const Space3 n{double(t::x(normal)), double(t::y(normal)), double(t::z(normal))};
        return v - inner(v, n) * n;
    }

    template <class D>
    static void scale(D& deposit, T s) {
        for (V& d : deposit.d_position)
            d = s * d;
    }

    /// A light, and how many coordinates its domain has.
    using Origin = std::pair<std::uint32_t, std::uint32_t>;
    [[nodiscard]] static Origin origin_of(const EmissionSample& sample) { return {sample.light, sample.coordinates}; }

    using OneField = std::conditional_t<domains.four, AreaField, FootprintField>;
    struct LightField {
        Origin origin;
        std::conditional_t<domains.two && domains.four, std::variant<FootprintField, AreaField>, std::variant<OneField>>
            field;
    };

    [[nodiscard]] static std::optional<FieldSample> sample_of(const FootprintField& field, const PathSample& photon) {
        return field.at(photon.sample.at, photon.frame, photon.signature);
    }
    [[nodiscard]] static std::optional<FieldSample> sample_of(const AreaField& field, const PathSample& photon) {
        return field.at(photon.sample, photon.frame, photon.signature);
    }

    /// Nothing for lights without a domain, or of which there are too few photons.
    [[nodiscard]] std::optional<FieldSample> field_at(const PathSample& photon) const {
        const Origin origin = origin_of(photon.sample);
        const auto found = std::lower_bound(fields_.begin(), fields_.end(), origin,
                                            [](const LightField& a, const Origin& o) { return a.origin < o; });
        if (found == fields_.end() || found->origin != origin)
            return std::nullopt;
        return std::visit([&](const auto& field) { return sample_of(field, photon); }, found->field);
    }

    Options options_;
    double others_ = default_smoothing;
    std::vector<LightField> fields_; // sorted by light
};

} // namespace nephroid::detail
