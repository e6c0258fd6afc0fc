// SPDX-License-Identifier: MIT
/// @file  Pictures from each quarter of the photons, from which smoothings are compared.
#pragma once

#include "nephroid/smoothing/leaf_sample.hpp"
#include "nephroid/splat/splat_in_batches.hpp"
#include "nephroid/splat/splat_photons.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// For each quarter of the photons, the picture that it makes by itself, at some of the vertices.
using QuarterPictures = std::array<std::vector<double>, 4>;

/// Splats the quarters with any smoothing.
///
/// @tparam DepositOf  deposit_of(i) is the optional deposit of photon i, emitted with smoothing 1
template <class V, class F, class R, class Policies, class DepositOf, class E>
class QuarterSplatter {
public:
    /// @param sums     provides the receiver and the response; it is not changed
    /// @param count    number of photons
    /// @param photons  emitted by the whole pass: the deposits' fluxes and tangents are those of so many photons
    QuarterSplatter(const Sums<V, F, R>& sums, const Policies& policies, std::size_t count, double photons,
                    const DepositOf& deposit_of, E& executor)
        : sums_(sums.map(), sums.response()), splatter_(sums_, policies), sample_(sums.map().tree(), vertices),
          per_quarter_(count / 4), photons_per_deposit_(photons / double(count / 4 * 4)), deposit_of_(deposit_of),
          executor_(executor) {}

    QuarterSplatter(const QuarterSplatter&) = delete; // refers to its own sums
    QuarterSplatter& operator=(const QuarterSplatter&) = delete;

    /// @param s  smoothing of the four quarters together; a single quarter then covers a quarter of s² times the
    ///           domain
    [[nodiscard]] QuarterPictures operator()(double s) {
        const Rescaling rescaling{s * std::sqrt(photons_per_deposit_), 4 * photons_per_deposit_};
        QuarterPictures pictures;
        for (std::size_t quarter = 0; quarter < pictures.size(); ++quarter) {
            sums_.clear();
            splat_in_batches(
                splatter_, per_quarter_,
                [&](std::uint64_t i, auto& chunk, Statistics& unused) {
                    if (const auto& deposit = deposit_of_(quarter * per_quarter_ + std::size_t(i)))
                        splatter_.prepare(rescaled(*deposit, rescaling), chunk, unused, sample_);
                },
                executor_);
            sample_.for_each([&](std::uint32_t leaf) {
                for (const F& sum : std::as_const(sums_).of_leaf(leaf))
                    pictures[quarter].push_back(flux_traits<F>::power(sum));
            });
        }
        return pictures;
    }

private:
    static constexpr std::size_t vertices = std::size_t(1) << 15;

    Sums<V, F, response_within<R>> sums_; // of flux: they are only compared
    Splatter<V, F, response_within<R>, Policies> splatter_;
    LeafSample sample_;
    std::size_t per_quarter_;
    double photons_per_deposit_; ///< emitted by the whole pass, over the photons at hand
    const DepositOf& deposit_of_;
    E& executor_;
};

} // namespace nephroid::detail
