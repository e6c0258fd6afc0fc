// SPDX-License-Identifier: MIT
/// @file  The search for a feature in the neighbourhood of one photon: Section 3.2.1 of Spencer and Jones 2009.
#pragma once

#include "nephroid/relaxation/discontinuity.hpp"
#include "nephroid/relaxation/flux_discontinuity.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/repulsion.hpp"
#include "nephroid/vector/frame.hpp"

#include <utility>

namespace nephroid::detail {

/// A stretch of an edge, found in one neighbourhood.
template <Vector3 V>
struct Feature {
    std::uint32_t origin; ///< slot of the photon whose neighbourhood it is
    V axis;               ///< δ: unit, across the edge, in the origin's tangent plane
    scalar_t<V> place;    ///< of the edge along the axis, from the origin, world units
    scalar_t<V> band;     ///< photons this far from the edge at most are on it
    scalar_t<V> radius;   ///< of the neighbourhood
    scalar_t<V> weight;   ///< ι', in (0, 1]
};

template <class Cloud>
class FeatureSearch {
public:
    using V = typename Cloud::vector;
    using F = typename Cloud::flux_type;
    using T = scalar_t<V>;

    /// Looks through the neighbourhood of the photon in a slot, and appends the features to `found`.
    ///
    /// @return  the radius of the neighbourhood
    T operator()(const Cloud& cloud, const RelaxationOptions& options, std::uint32_t slot,
                 std::vector<Feature<V>>& found) {
        const T radius = gather(cloud, options.feature_neighbours, slot);
        if (places_.size() < fewest || !(radius > T(0)))
            return radius;
        const auto keep = [&](const std::optional<Discontinuity>& d, const V& axis) {
            if (!d || d->evidence < options.evidence)
                return;
            const double weight = constraint_weight(d->homogeneity, options.alpha, options.beta);
            if (weight > 0)
                found.push_back({slot, axis, T(d->place) * radius,
                                 T(band_width * candidate_step(places_.size())) * radius, radius, T(weight)});
        };
        density_feature(options, radius, keep);
        if (options.flux_features)
            flux_feature(radius, keep);
        return radius;
    }

private:
    /// Fewer photons have no edge that could be told from chance.
    static constexpr std::size_t fewest = 16;
    /// In mean distances between photons. Measured: with 1 edges blur by a tenth, with 2 more is held than need be.
    static constexpr double band_width = 1.5;

    /// The nearest photons on the same surface, in the coordinates of the tangent plane.
    [[nodiscard]] T gather(const Cloud& cloud, std::size_t count, std::uint32_t slot) {
        const V origin = cloud.position(slot);
        frame_ = frame_about(cloud.normal(slot));
        detail::nearest_on_surface(cloud, slot, count, crowd_);
        T radius2(0);
        offsets_.clear();
        fluxes_.clear();
        for (const Neighbour<T>& other : crowd_) {
            const V offset = cloud.position(other.slot) - origin;
            offsets_.push_back({dot(offset, frame_.u), dot(offset, frame_.v)});
            fluxes_.push_back(cloud.flux(other.slot));
            radius2 = (std::max)(radius2, other.distance2);
        }
        places_.resize(offsets_.size());
        return sqrt(radius2);
    }

    /// The photons' places along an axis of the tangent plane, ascending.
    void sort_along(T a, T b, T radius) {
        for (std::size_t i = 0; i < offsets_.size(); ++i)
            places_[i] = (a * offsets_[i].first + b * offsets_[i].second) / radius;
        std::sort(places_.begin(), places_.end());
    }

    template <class Keep>
    void density_feature(const RelaxationOptions& options, T radius, const Keep& keep) {
        T u(0), v(0);
        for (const auto& offset : offsets_)
            u = u + offset.first, v = v + offset.second;
        const T size = sqrt(u * u + v * v);
        if (!(size > T(0)))
            return;
        u = u / size, v = v / size;
        sort_along(u, v, radius);
        if (options.criterion == FeatureCriterion::spread)
            return keep(least_spread<T>(places_), u * frame_.u + v * frame_.v);

        // The gradient of so few photons is off by some degrees: the axes about it have their say.
        auto best = most_likely<T>(places_);
        if (!best || best->evidence < 0.5 * options.evidence)
            return;
        T best_u = u, best_v = v;
        for (const double turn : {-0.2, -0.1, 0.1, 0.2}) {
            const T c = T(std::cos(turn)), s = T(std::sin(turn));
            sort_along(c * u - s * v, s * u + c * v, radius);
            const auto other = most_likely<T>(places_);
            if (other && other->evidence > best->evidence)
                best = other, best_u = c * u - s * v, best_v = s * u + c * v;
        }
        keep(best, best_u * frame_.u + best_v * frame_.v);
    }

    /// Across the direction in which the bands change most: the major axis of Σ_b G_b G_bᵀ with G_b the gradient of
    /// one.
    template <class Keep>
    void flux_feature(T radius, const Keep& keep) {
        T mean_u(0), mean_v(0);
        for (const auto& offset : offsets_)
            mean_u = mean_u + offset.first / T(offsets_.size()), mean_v = mean_v + offset.second / T(offsets_.size());
        F along_u = flux_traits<F>::zero(), along_v = flux_traits<F>::zero();
        for (std::size_t i = 0; i < offsets_.size(); ++i) {
            along_u = along_u + static_cast<F>(fluxes_[i] * T((offsets_[i].first - mean_u) / radius));
            along_v = along_v + static_cast<F>(fluxes_[i] * T((offsets_[i].second - mean_v) / radius));
        }
        const double uu = inner_product(along_u, along_u), uv = inner_product(along_u, along_v),
                     vv = inner_product(along_v, along_v);
        if (!(uu + vv > 0))
            return;
        const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
        const T a = T(std::cos(angle)), b = T(std::sin(angle));
        row_.resize(offsets_.size());
        for (std::size_t i = 0; i < offsets_.size(); ++i)
            row_[i] = {(a * offsets_[i].first + b * offsets_[i].second) / radius, std::uint32_t(i)};
        std::sort(row_.begin(), row_.end());
        row_fluxes_.clear();
        for (std::size_t i = 0; i < row_.size(); ++i) {
            places_[i] = row_[i].first;
            row_fluxes_.push_back(fluxes_[row_[i].second]);
        }
        keep(flux_discontinuity<T, F>(places_, row_fluxes_), a * frame_.u + b * frame_.v);
    }

    Frame<V> frame_{zero_vector<V>(), zero_vector<V>()};
    std::vector<Neighbour<T>> crowd_;
    std::vector<std::pair<T, T>> offsets_;
    std::vector<F> fluxes_, row_fluxes_;
    std::vector<T> places_;
    std::vector<std::pair<T, std::uint32_t>> row_;
};

} // namespace nephroid::detail
