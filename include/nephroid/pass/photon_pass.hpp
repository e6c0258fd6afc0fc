// SPDX-License-Identifier: MIT
/// @file  Which photons a pass traces: what splatting and the photon maps have in common.
#pragma once

#include "nephroid/emission/spread.hpp"
#include "nephroid/transport/walk_limits.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace nephroid {

/// The smoothing s where none is given: of splatting to first order, and to second order of photons without usable
/// neighbours.
inline constexpr double default_smoothing = 8;

/// Which photons a pass traces, and how large their footprints are.
struct PhotonPass {
    std::uint64_t first = 0; ///< index of the first photon
    std::uint64_t count = 0; ///< photons emitted in this pass, >= 1
    std::uint64_t total = 0; ///< N_e: the number that the lights' flux is divided by; 0 means `count`. A pass of a
                             ///< part of a picture's photons (a machine's share, say) gives the whole number here.
    /// s > 0: at emission the footprints cover the light's domain s² times. Nothing: chosen for each photon from those
    /// around it (smoothing/second_order/), where they say nothing `SmoothingBounds::least`, or `default_smoothing` for
    /// an area light; one for all photons of lights that declare no domain
    /// (smoothing/cross_validation.hpp); `default_smoothing` to first order.
    std::optional<double> smoothing{};
    WalkLimits limits{};
    /// Called between batches (of up to 8,192 photons when splatting, 65,536 in `trace_photons`) with the photons done
    /// so far in this pass, from the calling thread; false stops the pass. The picture then holds the photons that
    /// `Statistics::emitted` counts, each with its share of `total`.
    std::function<bool(std::uint64_t)> progress{};

    /// N_e: how many photons the whole picture has, of which this pass may trace a part.
    [[nodiscard]] std::uint64_t emitted_in_all() const { return total == 0 ? count : total; }
};

namespace detail {
/// @param caller  its name, for error messages
inline void check(const PhotonPass& pass, const char* caller) {
    if (pass.count == 0)
        invalid_argument(std::string(caller) + ": zero photons; count must be at least 1");
    if (pass.smoothing && (!(*pass.smoothing > 0) || !std::isfinite(*pass.smoothing)))
        invalid_argument(std::string(caller) + ": smoothing is " + text_of(*pass.smoothing) +
                         "; it must be positive and finite (5 to 16 suits most scenes)");
}

/// How the pass's photons spread: what a light is told at emission.
template <Scalar T>
[[nodiscard]] Spread<T> spread_of(const PhotonPass& pass) {
    return {T(pass.emitted_in_all()), T(pass.smoothing.value_or(default_smoothing))};
}
} // namespace detail

} // namespace nephroid
