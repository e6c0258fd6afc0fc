// SPDX-License-Identifier: MIT
/// @file  How noisy the mean of passes is at each vertex, found from how the passes differ.
#pragma once

#include "nephroid/receiver/sums.hpp"

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

/// The mean of the passes at one place, a vertex or a pixel, and how they differ [Welford 1962].
struct PassMoments {
    double mean = 0;
    double squares = 0; ///< of the distances from the mean, summed over the passes

    /// Adds a pass.
    ///
    /// @param passes  their number with this one, >= 1
    void add(double value, std::uint64_t passes) {
        const double away = value - mean;
        mean += away / double(passes);
        squares += away * (value - mean);
    }
    /// The variance of the mean; infinite before the second pass.
    [[nodiscard]] double variance_of_mean(std::uint64_t passes) const {
        return passes > 1 ? squares / (double(passes) * double(passes - 1)) : std::numeric_limits<double>::infinity();
    }
};

/// The root mean square of standard errors over the mean of the light, for as many places as there are: the share of
/// noise in the `relative_error` of quality/error.hpp.
class RelativeNoise {
public:
    void add(double mean, double variance_of_mean) {
        light_ += mean;
        variance_ += variance_of_mean;
        ++places_;
    }
    /// Infinite where no light has arrived.
    [[nodiscard]] double value() const {
        return light_ > 0 ? std::sqrt(variance_ * double(places_)) / light_ : std::numeric_limits<double>::infinity();
    }

private:
    double light_ = 0, variance_ = 0;
    std::uint64_t places_ = 0;
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
                add(by_slot_[leaves[leaf].first + i], flux_traits<F>::power(sums.at(leaves[leaf].first + i)));
    }

    [[nodiscard]] std::uint64_t passes() const { return passes_; }

    /// Calls sink(vertex index, mean of the passes, variance of that mean) once for each vertex; the variance is
    /// infinite before the second pass.
    template <class S>
        requires detail::MustTakeVariance<std::remove_reference_t<S>>
    void for_each(S&& sink) const {
        for (const TreeLeaf& leaf : map_->tree().leaves())
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                sink(std::size_t(map_->tree().index(slot)), by_slot_[slot].mean,
                     by_slot_[slot].variance_of_mean(passes_));
    }

    /// The noise of all vertices together (RelativeNoise). Infinite before the second pass, and where no light has
    /// arrived at all: bound the number of passes as well.
    [[nodiscard]] double relative_error() const {
        RelativeNoise noise;
        for_each([&](std::size_t, double mean, double variance) { noise.add(mean, variance); });
        return noise.value();
    }

    /// Begins again, for sums that were cleared.
    void clear() {
        by_slot_.assign(map_->tree().slots(), {});
        passes_ = 0;
    }

private:
    /// @param total  of all passes. Single precision rounds it: after n passes a pass is good to n 2^-24 of itself
    void add(PassMoments& moments, double total) const {
        moments.add(total - moments.mean * double(passes_ - 1), passes_);
    }

    const EyePathMap<V>* map_;
    std::vector<PassMoments> by_slot_;
    std::uint64_t passes_ = 0;
};

} // namespace nephroid
