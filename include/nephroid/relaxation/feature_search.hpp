// SPDX-License-Identifier: MIT
/// @file  The search for a feature in the neighbourhood of one photon: Section 3.2.1 of Spencer and Jones 2009.
#pragma once

#include "nephroid/relaxation/discontinuity.hpp"
#include "nephroid/relaxation/even_slope.hpp"
#include "nephroid/relaxation/flux_discontinuity.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/vector/frame.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A straight piece of an edge, found in one neighbourhood.
template <Vector3 V>
struct Feature {
    std::uint32_t origin; ///< slot of the photon whose neighbourhood it is
    V axis;               ///< δ: unit, across the edge, in the origin's tangent plane
    scalar_t<V> offset;   ///< of the edge from the origin along the axis, world units
    scalar_t<V> band;     ///< photons at most this far from the edge are on it
    scalar_t<V> radius;   ///< of the neighbourhood
    scalar_t<V> weight;   ///< ι', in (0, 1]
};

/// Searches neighbourhoods one after another; keeps its memory from one to the next.
template <class Cloud>
class FeatureSearch {
public:
    using V = typename Cloud::vector;
    using F = typename Cloud::flux_type;
    using T = scalar_t<V>;

    /// Searches the neighbourhood of the photon in a slot, and appends the features to `found`.
    ///
    /// @return  the radius of the neighbourhood
    T operator()(const Cloud& cloud, const RelaxationOptions& options, std::uint32_t slot,
                 std::vector<Feature<V>>& found) {
        const T radius = gather(cloud, options.feature_neighbours, slot);
        if (coordinates_.size() < fewest || !(radius > T(0)))
            return radius;
        const auto keep = [&](const std::optional<Discontinuity>& d, const V& axis) {
            if (!d || d->evidence < options.evidence)
                return;
            const double weight = constraint_weight(d->homogeneity, options.alpha, options.beta);
            if (weight > 0)
                found.push_back({slot, axis, T(d->coordinate) * radius,
                                 T(band_width * candidate_step(coordinates_.size())) * radius, radius, T(weight)});
        };
        density_feature(options, radius, keep);
        if (options.flux_features)
            flux_feature(radius, keep);
        return radius;
    }

private:
    /// Among fewer photons no edge can be told from chance.
    static constexpr std::size_t fewest = 16;
    /// In mean distances between photons. Measured: with 1 edges blur by a tenth, with 2 more photons are held than
    /// need be.
    static constexpr double band_width = 1.5;

    /// A photon's position in the tangent plane of the origin.
    struct InPlane {
        T u, v;
    };

    /// Takes in the nearest photons on the same surface.
    /// @return  the distance of the farthest
    [[nodiscard]] T gather(const Cloud& cloud, std::size_t count, std::uint32_t slot) {
        const V origin = cloud.position(slot);
        frame_ = frame_about(cloud.normal(slot));
        nearest_on_surface(cloud, slot, count, nearest_);
        T radius2(0);
        photons_.clear();
        fluxes_.clear();
        for (const Neighbour<T>& other : nearest_) {
            const V offset = cloud.position(other.slot) - origin;
            photons_.push_back({dot(offset, frame_.u), dot(offset, frame_.v)});
            fluxes_.push_back(cloud.flux(other.slot));
            radius2 = (std::max)(radius2, other.distance2);
        }
        coordinates_.resize(photons_.size());
        return sqrt(radius2);
    }

    /// Sets the photons' coordinates along an axis (a, b) of the tangent plane, ascending.
    void sort_along(T a, T b, T radius) {
        for (std::size_t i = 0; i < photons_.size(); ++i)
            coordinates_[i] = (a * photons_[i].u + b * photons_[i].v) / radius;
        std::sort(coordinates_.begin(), coordinates_.end());
    }

    /// Across the gradient of density: from the photon to the mean of its neighbours.
    template <class Keep>
    void density_feature(const RelaxationOptions& options, T radius, const Keep& keep) {
        T u(0), v(0);
        for (const InPlane& photon : photons_)
            u = u + photon.u, v = v + photon.v;
        const T size = sqrt(u * u + v * v);
        if (!(size > T(0)))
            return;
        u = u / size, v = v / size;
        sort_along(u, v, radius);
        if (options.criterion == FeatureCriterion::gap_variation)
            return keep(least_gap_variation<T>(coordinates_), u * frame_.u + v * frame_.v);

        // The gradient of so few photons is off by some degrees: axes on both sides of it are tried as well.
        auto best = most_likely<T>(coordinates_);
        if (!best || best->evidence < 0.5 * options.evidence)
            return;
        T best_u = u, best_v = v;
        constexpr double turns[] = {-0.2, -0.1, 0.1, 0.2};
        for (const double turn : turns) {
            const T c = T(std::cos(turn)), s = T(std::sin(turn));
            sort_along(c * u - s * v, s * u + c * v, radius);
            const auto other = most_likely<T>(coordinates_);
            if (other && other->evidence > best->evidence)
                best = other, best_u = c * u - s * v, best_v = s * u + c * v;
        }
        if (options.edge_evidence > 0) {
            const double mean = double(size / radius) / double(photons_.size());
            if (best->evidence - slope_evidence(photons_.size(), mean) < options.edge_evidence)
                return;
        }
        keep(best, best_u * frame_.u + best_v * frame_.v);
    }

    /// Along the direction in which the bands change most: the major axis of Σ_b G_b G_bᵀ with G_b the gradient of
    /// one.
    template <class Keep>
    void flux_feature(T radius, const Keep& keep) {
        T mean_u(0), mean_v(0);
        for (const InPlane& photon : photons_)
            mean_u = mean_u + photon.u / T(photons_.size()), mean_v = mean_v + photon.v / T(photons_.size());
        F along_u = flux_traits<F>::zero(), along_v = flux_traits<F>::zero();
        for (std::size_t i = 0; i < photons_.size(); ++i) {
            along_u = along_u + static_cast<F>(fluxes_[i] * T((photons_[i].u - mean_u) / radius));
            along_v = along_v + static_cast<F>(fluxes_[i] * T((photons_[i].v - mean_v) / radius));
        }
        const double uu = inner_product(along_u, along_u), uv = inner_product(along_u, along_v),
                     vv = inner_product(along_v, along_v);
        if (!(uu + vv > 0))
            return;
        const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
        const T a = T(std::cos(angle)), b = T(std::sin(angle));
        row_.resize(photons_.size());
        for (std::size_t i = 0; i < photons_.size(); ++i)
            row_[i] = {(a * photons_[i].u + b * photons_[i].v) / radius, std::uint32_t(i)};
        std::sort(row_.begin(), row_.end());
        row_fluxes_.clear();
        for (std::size_t i = 0; i < row_.size(); ++i) {
            coordinates_[i] = row_[i].first;
            row_fluxes_.push_back(fluxes_[row_[i].second]);
        }
        keep(flux_discontinuity<T, F>(coordinates_, row_fluxes_), a * frame_.u + b * frame_.v);
    }

    Frame<V> frame_{zero_vector<V>(), zero_vector<V>()};
    std::vector<Neighbour<T>> nearest_;
    std::vector<InPlane> photons_;
    std::vector<F> fluxes_, row_fluxes_;
    std::vector<T> coordinates_;
    std::vector<std::pair<T, std::uint32_t>> row_; ///< coordinate along the axis, and index
};

} // namespace nephroid::detail
