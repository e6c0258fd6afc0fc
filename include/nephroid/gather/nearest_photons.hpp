// SPDX-License-Identifier: MIT
/// @file  Standard photon mapping: the k nearest photons over the area that they lie in [Jensen 1996].
#pragma once

#include "nephroid/gather/coverage.hpp"
#include "nephroid/gather/differential_checking.hpp"
#include "nephroid/gather/gather.hpp"

#include <limits>
#include <utility>

namespace nephroid {

struct NearestPhotonsOptions {
    std::size_t count = 50;                                 ///< k >= 2: the bandwidth
    double range = std::numeric_limits<double>::infinity(); ///< photons farther away do not count, world units, > 0
    bool differential_checking = false;                     ///< fewer photons where the light changes
    DifferentialChecking checking{};                        ///< read only with `differential_checking`
    double normal_distance = 1; ///< > 0, in radii: photons farther from the tangent plane do not count. With 1 or more,
                                ///< all photons in the sphere do
};

/// Estimates irradiance as Σ Φ K(r²/R²)/R² over the photons nearest to a point, R the distance of the k-th.
///
/// Only photons on the side that the normal faces are searched for, so all k of them count. The k-th photon gives R and
/// nothing else, as K is zero at the rim: for random photons this makes the estimate unbiased with every kernel
/// [include/nephroid/README.md, "The k-th photon only gives the radius"].
///
/// Where `range` holds fewer than k photons, R is the range. Where there are fewer than k in all and no range, R is the
/// distance of the farthest. R is never below the resolution of positions, four epsilon of the distance from the
/// world's origin: where k photons lie in one place, the estimate is large and not infinite, also if these are all
/// there are.
///
/// ```cpp
/// const nephroid::NearestPhotons estimate(map, {.count = 100}, nephroid::ConeKernel{});
/// const float e = estimate(position, normal);
/// ```
///
/// Several threads may call at once; each keeps memory for k neighbours. A response must therefore not call another
/// estimate from nearest photons itself.
template <Vector3 V, Flux F, class K = BiweightKernel, class C = WholeDisk>
    requires Kernel<K, scalar_t<V>> && detail::MustBeCoverage<C, V>
class NearestPhotons {
public:
    using T = scalar_t<V>;

    /// @param map     is referred to, and must outlive the estimate
    /// @param kernel  UniformKernel, ConeKernel (Jensen's with k = 1), BiweightKernel, … (footprint/kernel.hpp)
    /// @param coverage  the share of the disk of radius R that lies on the surface (gather/coverage.hpp)
    /// Throws std::invalid_argument for k < 2 (a single photon gives no area), and for lengths that are not positive.
    NearestPhotons(const PhotonMap<V, F>& map, NearestPhotonsOptions options = {}, K kernel = {}, C coverage = {})
        : map_(&map), options_(options), kernel_(kernel), coverage_(std::move(coverage)) {
        constexpr const char* who = "nephroid::NearestPhotons";
        if (options.count < 2)
            invalid_argument(std::string(who) + ": count is " + std::to_string(options.count) +
                             "; the farthest photon only sets the radius, so it must be at least 2");
        detail::check_radius<T>(who, "range", options.range, true);
        detail::check_positive(who, "normal_distance", options.normal_distance, true);
        if (options.differential_checking)
            detail::check(options.checking, who);
        range2_ = square(T(options.range));
        const T epsilon = std::numeric_limits<T>::epsilon();
        least_radius_ = square(T(4) * epsilon) * map.diagonal();
        if (!(least_radius_ > T(0))) // one place, perhaps the world's origin: any radius whose square can be divided by
            least_radius_ = sqrt(sqrt((std::numeric_limits<T>::min)()));
    }
    NearestPhotons(const PhotonMap<V, F>&&, NearestPhotonsOptions = {}, K = {},
                   C = {}) = delete; // would refer to a temporary

    /// The irradiance at a point of a surface; a position or normal that is not finite receives nothing.
    /// @param normal  unit; photons on the other side do not count
    [[nodiscard]] F operator()(const V& position, const V& normal) const {
        return (*this)(position, normal, detail::NoResponse{});
    }

    /// The same with each photon's irradiance times response(direction of flight): the BRDF; the sum is radiance.
    template <class Response>
    [[nodiscard]] F operator()(const V& position, const V& normal, const Response& response) const {
        F sum = flux_traits<F>::zero();
        const std::size_t wanted = (std::min)(options_.count, map_->tree().slots());
        if (wanted == 0 || !all_finite(position) || !all_finite(normal))
            return sum;
        const V relative = map_->tree().relative(position);
        const std::span<Neighbour<T>> room = detail::neighbours<T>(wanted);
        const std::size_t found =
            map_->tree().nearest(relative, room, range2_, [&](std::size_t slot) { return map_->faces(slot, normal); });
        const T least_radius = (std::max)(least_radius_, T(4) * std::numeric_limits<T>::epsilon() * length(position));
        const auto [neighbours, radius2] = disk(room.first(found), square(least_radius));
        if (!(radius2 > T(0)))
            return sum;

        const T scale = T(1) / radius2, thickness2 = square(T(options_.normal_distance)) * radius2;
        const bool slab = options_.normal_distance < 1;
        const T inside = T(1) - std::numeric_limits<T>::epsilon(); // just inside the rim
        F rim = flux_traits<F>::zero();
        std::size_t on_rim = 0;
        for (const Neighbour<T>& n : neighbours) {
            const bool is_on_rim = !(n.distance2 < radius2); // not by `scale`: radius2 * (1 / radius2) may be below 1
            on_rim += std::size_t(is_on_rim);
            if (slab && !(square(detail::height(*map_, n.slot, relative, normal)) < thickness2))
                continue;
            const T weight = kernel_(is_on_rim ? inside : T(n.distance2 * scale)) * scale;
            detail::receive(is_on_rim ? rim : sum, *map_, n.slot, weight, response);
        }
        if (on_rim > 1)
            sum = sum + rim * T(1 - 1 / double(on_rim));
        return detail::over_coverage(coverage_, sum, position, normal, sqrt(radius2));
    }

private:
    struct Disk {
        std::span<const Neighbour<T>> neighbours;
        T radius2;
    };

    /// The photons that count, and the squared radius of the disk around them.
    [[nodiscard]] Disk disk(std::span<Neighbour<T>> found, T least_radius2) const {
        const auto nearer = [](const Neighbour<T>& a, const Neighbour<T>& b) { return a.distance2 < b.distance2; };
        if (found.empty())
            return {found, T(0)};
        bool complete = found.size() == options_.count;
        if (options_.differential_checking) {
            std::sort(found.begin(), found.end(), nearer);
            const std::size_t checked = detail::checked_count<V, F>(*map_, found, options_.checking);
            complete = complete || checked < found.size();
            found = found.first(checked);
        }
        if (!complete && isfinite(range2_))
            return {found, range2_};
        const T farthest2 = std::max_element(found.begin(), found.end(), nearer)->distance2;
        return {found, (std::max)(farthest2, least_radius2)};
    }

    const PhotonMap<V, F>* map_;
    NearestPhotonsOptions options_;
    K kernel_;
    C coverage_;
    T range2_;
    T least_radius_; ///< at the world's origin
};

} // namespace nephroid
