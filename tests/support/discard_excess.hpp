// SPDX-License-Identifier: MIT
/// @file  Footprint policies as a renderer may write its own.
#pragma once

#include "nephroid/footprint/policies.hpp"

namespace nephroid::tests {

/// Discards a photon whose major radius exceeds so many diagonals.
struct DiscardExcess {
    double diagonals = 1;
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>& ellipse, scalar_t<V> diagonal) const {
        const scalar_t<V> bound = scalar_t<V>(diagonals) * diagonal;
        return radii(ellipse).major <= bound || !(bound > scalar_t<V>(0)) ? Verdict::kept : Verdict::discarded;
    }
};

/// Widens a footprint whose minor radius is below so many spacings.
struct WidenCollapsed {
    double spacings = 0.5;
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>& ellipse, scalar_t<V> spacing) const {
        using T = scalar_t<V>;
        const T least = T(spacings) * spacing;
        const auto sigma = radii(ellipse);
        if (sigma.minor >= least)
            return sigma.minor > T(0) ? Verdict::kept : Verdict::discarded;
        ellipse = add_disk(ellipse, sqrt((least - sigma.minor) * (least + sigma.minor)));
        return Verdict::bounded;
    }
};

} // namespace nephroid::tests
