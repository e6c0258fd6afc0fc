// SPDX-License-Identifier: MIT
/// @file  Differential checking: fewer photons where the light changes [Jensen and Christensen 1995].
#pragma once

#include "nephroid/gather/photon_map.hpp"

#include <limits>

namespace nephroid {

/// Options of differential checking, which stops adding photons, nearest first, where the disk reaches other light.
///
/// From time to time the estimate E with a constant kernel is checked. In even light ln E of n random photons has the
/// standard deviation 1/√n (for unequal fluxes n is (ΣΦ)²/ΣΦ²), so each check confines ln E to an interval of
/// half width `significance`/√n. Where these intervals have no point in common any more, the disk has reached
/// other light, and the photons of the previous check are taken. This is Lepski's choice of a bandwidth, the largest
/// whose estimate no smaller one contradicts; the papers on differential checking leave the rule open
/// [include/nephroid/README.md, "Differential checking"].
///
/// With the defaults, even light of random photons is cut short in fewer than 0.1% of places for 200 photons, in 0.7%
/// for 1000 and in 2.1% for 4000; of stratified photons more rarely.
///
/// No test can tell a detail from an edge. Where the light changes within a pixel, estimates follow it, and a picture
/// with one eye path in a pixel aliases: give the pixel's size as `resolution`.
///
/// Sources: Lepski 1990, "On a problem of adaptive estimation in Gaussian white noise"; intersecting intervals as in
/// Goldenshluger and Nemirovski 1997, "On spatially adaptive estimation of nonparametric regression".
struct DifferentialChecking {
    std::size_t least = 32;    ///< photons at the first check, >= 2
    double growth = 1.25;      ///< photons at a check over those at the one before, > 1, <= 1e6
    double significance = 2.5; ///< half width of an interval, in standard deviations of a random count, > 0
    double resolution = 0;     ///< photons nearer than this are always taken, world units, >= 0
};

namespace detail {
inline void check(const DifferentialChecking& checking, const char* who) {
    if (checking.least < 2)
        invalid_argument(std::string(who) + ": checking.least is " + std::to_string(checking.least) +
                         "; it must be at least 2");
    if (!(checking.growth > 1) || !(checking.growth <= 1e6))
        invalid_argument(std::string(who) + ": checking.growth is " + text_of(checking.growth) +
                         "; it must be greater than 1 and at most a million");
    if (!(checking.significance > 0))
        invalid_argument(std::string(who) + ": checking.significance is " + text_of(checking.significance) +
                         "; it must be positive");
    if (!(checking.resolution >= 0))
        invalid_argument(std::string(who) + ": checking.resolution is " + text_of(checking.resolution) +
                         "; it must not be negative");
}

/// The interval of ln E that all checks so far agree on.
class Agreement {
public:
    explicit Agreement(double significance) : significance_(significance) {}

    /// Adds a check.
    /// @param photons  that the estimate is worth, > 0
    /// @return  whether it agrees with all before
    [[nodiscard]] bool add(double estimate, double photons) {
        const double middle = std::log(estimate), half = significance_ / std::sqrt(photons);
        low_ = (std::max)(low_, middle - half);
        high_ = (std::min)(high_, middle + half);
        return low_ <= high_;
    }

private:
    double significance_;
    double low_ = -std::numeric_limits<double>::infinity(), high_ = std::numeric_limits<double>::infinity();
};

/// How many of the photons, nearest first, an estimate takes: the last of them gives the radius.
template <Vector3 V, Flux F>
[[nodiscard]] std::size_t checked_count(const PhotonMap<V, F>& map, std::span<const Neighbour<scalar_t<V>>> sorted,
                                        const DifferentialChecking& checking) {
    const double resolution2 = checking.resolution * checking.resolution;
    Agreement agreement(checking.significance);
    double power = 0, power2 = 0; // sums of flux and of its square over all nearer photons
    std::size_t agreed = sorted.size(), next = checking.least;
    for (std::size_t count = 1; count <= sorted.size(); ++count) {
        const double farthest2 = double(sorted[count - 1].distance2);
        if (count >= next || count == sorted.size()) {
            if (farthest2 > resolution2 && power > 0) {
                if (!agreement.add(power / farthest2, power * power / power2))
                    return agreed;
                agreed = count;
            }
            next = (std::max)(count + 1, std::size_t(std::ceil(double(count) * checking.growth)));
        }
        const double flux = double(flux_traits<F>::power(map.flux(sorted[count - 1].slot)));
        power += flux;
        power2 += flux * flux;
    }
    return sorted.size();
}
} // namespace detail

} // namespace nephroid
