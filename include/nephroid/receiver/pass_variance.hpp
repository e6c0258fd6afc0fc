// SPDX-License-Identifier: MIT
/// @file  How noisy the mean of passes is at each vertex, found from how the passes differ.
#pragma once

#include "nephroid/receiver/sums.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace nephroid {

namespace detail {
template <class S>
concept TakesVariance = std::invocable<S&, std::size_t, double, double>;

template <class S>
consteval bool explain_variance_sink() {
    static_assert(TakesVariance<S>, "nephroid: the sink of PassVariance::for_each cannot be called as sink(std::size_t "
                                    "vertex, double mean, double variance) (receiver/pass_variance.hpp)");
    return false;
}
template <class S>
concept MustTakeVariance = TakesVariance<S> || explain_variance_sink<S>();
} // namespace detail

/// How the passes at one place differ, a vertex or a pixel, by Welford's update, in which no digits cancel.
struct PassMoments {
    double sum = 0;     ///< over all passes
    double squares = 0; ///< of the distances of passes from their mean, summed

    /// Adds a pass.
    ///
    /// @param total   over all passes so far, with this one
    /// @param passes  their number, >= 1
    void add(double total, std::uint64_t passes) {
        const double value = total - sum;
        const double before = passes > 1 ? sum / double(passes - 1) : value;
        squares += (value - before) * (value - total / double(passes));
        sum = total;
    }
    [[nodiscard]] double mean(std::uint64_t passes) const { return passes > 0 ? sum / double(passes) : 0; }
    /// The variance of that mean; infinite before the second pass.
    [[nodiscard]] double variance_of_mean(std::uint64_t passes) const {
        return passes > 1 ? (std::max)(squares, 0.0) / (double(passes) * double(passes - 1))
                          : std::numeric_limits<double>::infinity();
    }
};

/// The variance of the mean of passes at each vertex: what a viewer needs in order to stop, and a denoiser as its
/// guide. It watches sums of any kind of light from outside, as passes of equally many photons are added to them.
///
/// ```cpp
/// auto sums = nephroid::sums<Colour>(map);
/// nephroid::PassVariance<Vec3, Colour> variance(map);
/// do {
///     nephroid::caustics(scene, lamp, sums, {.first = variance.passes() * 50'000, .count = 50'000}, threads);
///     variance.end_pass(sums);
/// } while (variance.passes() < 4 || (variance.passes() < 1000 && variance.relative_error() > 0.02));
/// ```
///
/// It is the variance of noise alone. A bias that all passes share, as that of footprints of one size, is not seen. It
/// is that of independent passes: those of a stratified sequence complement each other, so that their mean is better
/// than this says. Values are powers (`flux_traits`) per world unit squared. Memory: two doubles for each slot of the
/// map's tree.
///
/// @tparam V  vector
/// @tparam F  flux
template <detail::MustBeVector V, class F>
    requires detail::MustBeFluxFor<F, V>
class PassVariance {
public:
    /// @param map  of the sums; kept by reference, must outlive this
    explicit PassVariance(const EyePathMap<V>& map) : map_(&map) { clear(); }
    explicit PassVariance(const EyePathMap<V>&&) = delete; // would refer to a temporary

    /// Takes what was added to the sums since the last call for one pass. Before the first call they must be zero.
    /// Throws std::invalid_argument for sums of another map.
    template <class R>
    void end_pass(const Sums<V, F, R>& sums) {
        if (&sums.map() != map_)
            invalid_argument("nephroid::PassVariance::end_pass: the sums are those of another map");
        ++passes_;
        const auto leaves = map_->tree().leaves();
        for (std::uint32_t leaf = 0; leaf < leaves.size(); ++leaf)
            for (std::size_t i = 0; i < leaves[leaf].size; ++i)
                by_slot_[leaves[leaf].first + i].add(flux_traits<F>::power(sums.of_leaf(leaf)[i]), passes_);
    }

    [[nodiscard]] std::uint64_t passes() const { return passes_; }

    /// Calls sink(vertex index, mean of the passes, variance of that mean) once for each vertex; the variance is
    /// infinite before the second pass.
    template <class S>
        requires detail::MustTakeVariance<std::remove_reference_t<S>>
    void for_each(S&& sink) const {
        for (const TreeLeaf& leaf : map_->tree().leaves())
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                sink(std::size_t(map_->tree().index(slot)), by_slot_[slot].mean(passes_),
                     by_slot_[slot].variance_of_mean(passes_));
    }

    /// The root mean square of the standard errors over the mean light at the vertices: the share of noise in the
    /// `relative_error` of quality/error.hpp. Infinite before the second pass, and where no light has arrived at all:
    /// bound the number of passes as well.
    [[nodiscard]] double relative_error() const {
        double light = 0, variance = 0;
        std::size_t vertices = 0;
        for_each([&](std::size_t, double mean, double of_mean) {
            light += mean;
            variance += of_mean;
            ++vertices;
        });
        return light > 0 ? std::sqrt(variance * double(vertices)) / light : std::numeric_limits<double>::infinity();
    }

    /// Begins again, for sums that were cleared.
    void clear() {
        by_slot_.assign(map_->tree().slots(), {});
        passes_ = 0;
    }

private:
    const EyePathMap<V>* map_;
    std::vector<PassMoments> by_slot_;
    std::uint64_t passes_ = 0;
};

} // namespace nephroid
