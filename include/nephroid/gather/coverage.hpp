// SPDX-License-Identifier: MIT
/// @file  The share of a disk that lies on the surface: less than all of it at a surface's border, where an estimate
///        that divides by the whole disk is too dark. Told by the caller here, and by the renderer's rays in
///        gather/free_distance_coverage.hpp.
///
/// ```cpp
/// const auto on_table = [](const V& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 2; };
/// const nephroid::NearestPhotons estimate(map, {.count = 20}, nephroid::BiweightKernel{},
///                                         nephroid::SampledCoverage{on_table, nephroid::BiweightKernel{}});
/// ```
#pragma once

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/frame.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <utility>

namespace nephroid {

/// Tells which share of the disk about a position lies on the surface: coverage(position, normal, radius) -> share in
/// (0, 1]. Position and radius are in world units, the normal is unit. An estimate takes any other share, zero and NaN
/// among them, as 1. Called from several threads at once.
///
/// The share of the kernel's weight makes an estimate in even light right at every border. The share of the area is
/// simpler, but right for `UniformKernel` alone: other kernels weigh the middle of the disk more, which is always on
/// the surface, so the estimate becomes too bright. The two agree only on a straight border, where both are a half.
template <class C, class V>
concept DiskCoverage = requires(const C coverage, const V& v, scalar_t<V> radius) {
    { coverage(v, v, radius) } -> std::convertible_to<scalar_t<V>>;
};

/// Takes every disk to lie on the surface wholly.
struct WholeDisk {
    template <class V>
    [[nodiscard]] constexpr scalar_t<V> operator()(const V&, const V&, scalar_t<V>) const {
        return scalar_t<V>(1);
    }
};

/// The share of a kernel's weight, from 96 points of the disk. The caller's function says which of them are on the
/// surface. They lie on a spiral, each for the same area, so the share is off by about 1%: far less than the noise of
/// the photons at a border.
template <class OnSurface, class K = BiweightKernel>
class SampledCoverage {
public:
    /// @param on_surface  on_surface(position in the tangent plane) -> bool
    /// @param kernel      the estimate's
    explicit SampledCoverage(OnSurface on_surface, K kernel = {})
        : on_surface_(std::move(on_surface)), kernel_(kernel) {
        for (std::size_t i = 0; i < points; ++i) {
            constexpr double golden_angle = 2.39996322972865332;
            radius2_[i] = (double(i) + 0.5) / double(points);
            cosine_[i] = std::cos(golden_angle * double(i));
            sine_[i] = std::sin(golden_angle * double(i));
        }
    }

    template <class V>
    [[nodiscard]] scalar_t<V> operator()(const V& position, const V& normal, scalar_t<V> radius) const {
        using T = scalar_t<V>;
        const Frame<V> frame = frame_about(normal);
        T inside(0), all(0);
        for (std::size_t i = 0; i < points; ++i) {
            const T weight = kernel_(T(radius2_[i])), distance = radius * T(std::sqrt(radius2_[i]));
            const V point = position + (distance * T(cosine_[i])) * frame.u + (distance * T(sine_[i])) * frame.v;
            all = all + weight;
            if (on_surface_(point))
                inside = inside + weight;
        }
        return inside / all;
    }

private:
    static constexpr std::size_t points = 96;
    OnSurface on_surface_;
    K kernel_;
    std::array<double, points> radius2_, cosine_, sine_; ///< of the points, on the unit disk
};

namespace detail {
template <class C, class V>
consteval bool explain_coverage() {
    static_assert(DiskCoverage<C, V>,
                  "nephroid: a coverage is called as coverage(position, normal, radius) and returns the share of the "
                  "disk that lies on the surface (gather/coverage.hpp)");
    return false;
}

template <class C, class V>
concept MustBeCoverage = DiskCoverage<C, V> || explain_coverage<C, V>();

/// An estimate over a disk that the surface fills in part only.
template <class C, class F, class V>
[[nodiscard]] F over_coverage(const C& coverage, const F& sum, const V& position, const V& normal, scalar_t<V> radius) {
    using T = scalar_t<V>;
    if constexpr (std::same_as<C, WholeDisk>) {
        return sum;
    } else {
        const T share = T(coverage(position, normal, radius));
        return share > T(0) && share < T(1) ? static_cast<F>(sum * (T(1) / share)) : sum;
    }
}
} // namespace detail

} // namespace nephroid
