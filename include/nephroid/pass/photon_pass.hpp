// SPDX-License-Identifier: MIT
/// @file  The options of a pass of photons, for splatting and for photon maps alike.
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

/// The smoothing s if none is given, in first order and for stored photons. Second order uses it only where neighbours
/// contradict the fit, and for photons of an area light without enough neighbours.
inline constexpr double default_smoothing = 8;

/// Which photons a pass traces, and how large their footprints are.
struct PhotonPass {
    std::uint64_t first = 0; ///< index of the first photon
    std::uint64_t count = 0; ///< photons emitted in this pass, >= 1
    std::uint64_t total = 0; ///< N_e: the number that the lights' flux is divided by; 0 means `count`. A pass of only a
                             ///< part of a picture's photons (one machine's, say) gives the whole number here.
    /// s > 0: at emission the footprints cover the light's domain s² times. If empty, first order uses
    /// `default_smoothing`. Second order then chooses it for each photon from those around it
    /// (smoothing/second_order/); where they do not suffice, it is `SmoothingBounds::least`, or `default_smoothing` for
    /// an area light. All photons of lights without a domain get the same one (smoothing/cross_validation.hpp).
    std::optional<double> smoothing{};
    WalkLimits limits{};
    /// Called from the calling thread after each batch (of up to 8,192 photons when splatting, 65,536 in
    /// `trace_photons`) with the number of photons done so far in this pass. If it returns false, the pass stops. The
    /// picture then holds the photons that `Statistics::emitted` counts, each with its share of `total`.
    std::function<bool(std::uint64_t)> progress{};

    /// N_e: the number of photons of the whole picture; this pass may trace only a part of them.
    [[nodiscard]] std::uint64_t emitted_in_all() const { return total == 0 ? count : total; }
};

namespace detail {
/// Throws std::invalid_argument for options that make no sense.
///
/// @param caller  name of the calling function, for the message
NEPHROID_NOINLINE inline void check(const PhotonPass& pass, const char* caller) {
    if (pass.count == 0)
        invalid_argument(std::string(caller) + ": zero photons; count must be at least 1");
    if (pass.total != 0 && pass.count > pass.total)
        invalid_argument(
            std::string(caller) + ": count is " + std::to_string(pass.count) + " and total " +
            std::to_string(pass.total) +
            "; a pass traces a part of all photons, so total must be at least count, or 0 for count itself");
    if (pass.smoothing && (!(*pass.smoothing > 0) || !std::isfinite(*pass.smoothing)))
        invalid_argument(std::string(caller) + ": smoothing is " + text_of(*pass.smoothing) +
                         "; it must be positive and finite (5 to 16 suits most scenes)");
}

/// The spread of the pass's photons, which lights need at emission.
template <Scalar T>
[[nodiscard]] Spread<T> spread_of(const PhotonPass& pass) {
    return {T(pass.emitted_in_all()), T(pass.smoothing.value_or(default_smoothing))};
}
} // namespace detail

} // namespace nephroid
