// SPDX-License-Identifier: MIT
/// @file  Where the flux of a row of photons changes, in intensity or in colour: what Spencer and Jones 2009 leave as
///        future work, by the means of their density features.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/relaxation/discontinuity.hpp"

#include <span>

namespace nephroid::detail {

/// The inner product of two fluxes, the mean over the bands: all that is known of a flux type is that it multiplies
/// band by band and has a power.
template <Flux F>
[[nodiscard]] double inner_product(const F& a, const F& b) {
    return flux_traits<F>::power(static_cast<F>(a * b));
}

/// 1 − |a − b|/max(|a|, |b|), at least 0, from the inner products of two fluxes: for one band the ratio of the
/// smaller to the larger [as in eq. 7]. 1 where both are zero.
[[nodiscard]] inline double homogeneity_of(double aa, double ab, double bb) {
    const double larger = (std::max)(aa, bb);
    return larger > 0 ? (std::max)(0.0, 1 - std::sqrt((std::max)(0.0, aa + bb - 2 * ab) / larger)) : 1;
}

/// The homogeneity of two photons' fluxes; the same bits with the two exchanged.
template <Flux F>
[[nodiscard]] double flux_homogeneity(const F& a, const F& b) {
    return homogeneity_of(inner_product(a, a), inner_product(a, b), inner_product(b, b));
}

/// The sums from which the mean and the variance of some photons' flux follow.
template <Flux F>
struct FluxSums {
    double count = 0, squares = 0;
    F sum = flux_traits<F>::zero();

    void add(const F& flux) {
        count += 1;
        sum = sum + flux;
        squares += inner_product(flux, flux);
    }
    /// Σ |Φ − mean|²
    [[nodiscard]] double squared_deviations() const {
        return (std::max)(0.0, squares - inner_product(sum, sum) / count);
    }
};

/// Splits a row of photons into two sides of even flux: the least sum of squared deviations from the two means, over
/// all bands.
///
/// The homogeneity is 1 − |m_1 − m_2|/max |m|, for one band the ratio of the two means as in eq. 7; colours without
/// a band in common differ as much as bright and dark. The evidence is the logarithm of the likelihood ratio of normal
/// distributions about one and two means, n/2 log(S/(S_1 + S_2)).
///
/// @param coordinates  ascending, over the radius of the disc
/// @param fluxes       in the same order
/// @return  nothing for fewer than 16 photons (8 on each side), or if fluxes differ by rounding alone
template <class T, Flux F>
[[nodiscard]] std::optional<Discontinuity> flux_discontinuity(std::span<const T> coordinates,
                                                              std::span<const F> fluxes) {
    constexpr std::size_t fewest = 8; // photons of a side: the mean of fewer says little
    constexpr double rounding = 1e-5; // of |Φ|², in sums over some hundred photons in single precision
    FluxSums<F> all, left;
    for (const F& flux : fluxes)
        all.add(flux);
    const double nothing = rounding * all.squares;
    if (fluxes.size() < 2 * fewest || !(all.squared_deviations() > nothing))
        return std::nullopt;

    std::optional<Discontinuity> best;
    for (std::size_t i = 0; i + fewest < fluxes.size(); ++i) {
        left.add(fluxes[i]);
        if (i + 1 < fewest)
            continue;
        // A flux type need not subtract: the inner products of what is on the right follow from those of the sums.
        const double n_left = left.count, n_right = all.count - n_left;
        const double left2 = inner_product(left.sum, left.sum);
        const double left_all = inner_product(left.sum, all.sum);
        const double all2 = inner_product(all.sum, all.sum);
        const double right2 = (std::max)(0.0, all2 - 2 * left_all + left2);
        const double within = (std::max)(nothing, all.squares - left2 / n_left - right2 / n_right);
        const double evidence = 0.5 * all.count * std::log((std::max)(all.squared_deviations(), nothing) / within);
        if (best && evidence <= best->evidence)
            continue;
        const double homogeneity =
            homogeneity_of(left2 / square(n_left), (left_all - left2) / (n_left * n_right), right2 / square(n_right));
        best = Discontinuity{0.5 * (double(coordinates[i]) + double(coordinates[i + 1])), homogeneity, evidence};
    }
    return best;
}

} // namespace nephroid::detail
