// SPDX-License-Identifier: MIT
/// @file  Differential checking: fewer photons where the light changes [Jensen and Christensen 1995].
#pragma once

#include "nephroid/map/photon_map.hpp"

namespace nephroid {

/// When to stop adding photons. They are added nearest first, and the estimate with a constant kernel is looked at from
/// time to time. Once it has grown at `run` looks in a row, or shrunk, and by more in all than chance explains
/// (`significance` over the square root of the photons at the run's start, of the estimate there), the disk has reached
/// into other light: the photons from before the run are taken.
///
/// The papers that describe the method leave the rule open ("if a large difference is detected"); this one is
/// nephroid's.
struct DifferentialChecking {
    std::size_t least = 32;  ///< photons at the first look, >= 2
    double growth = 1.25;    ///< photons at a look over those at the one before, > 1
    std::size_t run = 2;     ///< looks in a row, >= 1
    double significance = 3; ///< standard deviations of a random count, >= 0
};

namespace detail {
inline void check(const DifferentialChecking& checking, const char* who) {
    if (checking.least < 2)
        invalid_argument(std::string(who) + ": checking.least is " + std::to_string(checking.least) +
                         "; it must be at least 2");
    if (!(checking.growth > 1))
        invalid_argument(std::string(who) + ": checking.growth is " + text_of(checking.growth) +
                         "; it must be greater than 1");
    if (checking.run == 0)
        invalid_argument(std::string(who) + ": checking.run is 0; it must be at least 1");
    if (!(checking.significance >= 0))
        invalid_argument(std::string(who) + ": checking.significance is " + text_of(checking.significance) +
                         "; it must not be negative");
}

/// Watches estimates as they come in.
class TrendWatch {
public:
    explicit TrendWatch(const DifferentialChecking& checking) : checking_(checking) {}

    /// Takes the estimate of the first `count` photons. True where a trend has been established, which began after the
    /// first `before_trend()` photons.
    [[nodiscard]] bool look(std::size_t count, double estimate) {
        const int direction = estimate > last_ ? 1 : estimate < last_ ? -1 : 0;
        if (looks_ == 0 || direction != direction_ || direction == 0) {
            // The trend, if there is one now, began at the look before.
            start_ = looks_ == 0 ? estimate : last_;
            start_count_ = looks_ == 0 ? count : last_count_;
            direction_ = looks_ == 0 ? 0 : direction;
            run_ = 0;
        }
        run_ += direction_ != 0 ? 1 : 0;
        ++looks_;
        last_ = estimate;
        last_count_ = count;
        const double chance = checking_.significance / std::sqrt(double(start_count_)) * start_;
        return run_ >= checking_.run && std::abs(estimate - start_) > chance;
    }

    [[nodiscard]] std::size_t before_trend() const { return start_count_; }

private:
    DifferentialChecking checking_;
    std::size_t looks_ = 0, run_ = 0, last_count_ = 0, start_count_ = 0;
    double last_ = 0, start_ = 0;
    int direction_ = 0;
};

/// How many of the photons, nearest first, are to be taken: the last of them gives the radius.
template <Vector3 V, Flux F>
[[nodiscard]] std::size_t checked_count(const PhotonMap<V, F>& map, std::span<const Neighbour<scalar_t<V>>> sorted,
                                        const DifferentialChecking& checking) {
    TrendWatch watch(checking);
    double power = 0; // of all photons but the last
    std::size_t next = checking.least;
    for (std::size_t count = 1; count <= sorted.size(); ++count) {
        const Neighbour<scalar_t<V>>& farthest = sorted[count - 1];
        if (count == next || count == sorted.size()) {
            if (farthest.distance2 > scalar_t<V>(0) && watch.look(count, power / double(farthest.distance2)))
                return watch.before_trend();
            next = (std::max)(count + 1, std::size_t(std::ceil(double(count) * checking.growth)));
        }
        power += double(flux_traits<F>::power(map.flux(farthest.slot)));
    }
    return sorted.size();
}
} // namespace detail

} // namespace nephroid
