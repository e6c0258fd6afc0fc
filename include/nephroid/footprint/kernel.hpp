// SPDX-License-Identifier: MIT
/// @file  Footprint kernels: how a photon's flux is spread over the unit disk.
///
/// A kernel is a small type with
///   - `operator()(r2)` for the squared radius r2 = |x|² >= 0: k >= 0, zero for r2 >= 1, and ∫ k over the disk = 1.
///     It should not branch (use `keep_if`), because it is called in a loop that the compiler vectorises;
///   - `second_moment`: ∫ x² k over the disk, the variance along one axis. The pixel filter and second order need
///     it;
///   - `mass_within(r2)`, optional: ∫ k over the disk of squared radius r2 in [0, 1]. Without it the integral is
///     computed by quadrature (footprint/kernel_mass.hpp).
///
/// ```cpp
/// struct Triweight { // 4/π (1 − r²)³
///     static constexpr double second_moment = 1.0 / 10;
///     template <nephroid::Scalar T>
///     T operator()(const T& radius2) const {
///         const T rest = nephroid::keep_if(radius2 < T(1), T(T(1) - radius2));
///         return T(4) / nephroid::pi<T> * rest * rest * rest;
///     }
/// };
/// nephroid::caustics(scene, light, sums, pass, nephroid::Default{}.with_kernel(Triweight{}));
/// ```
#pragma once

#include "nephroid/vector/stable.hpp"

namespace nephroid {

namespace detail {
template <class K, class T>
concept MapsRadius2 = requires(const K kernel, const T radius2) {
    { kernel(radius2) } -> std::same_as<T>;
};

template <class K>
concept HasSecondMoment = requires {
    { K::second_moment } -> std::convertible_to<double>;
};
} // namespace detail

/// The compiler checks the call; `tests/footprint/kernel_laws.hpp` checks the meaning, for every model.
template <class K, class T = float>
concept Kernel = std::semiregular<K> && Scalar<T> && detail::MapsRadius2<K, T>;

/// The radius of a disk that under kernel K has the variance of a pixel box, in units of the pixel's side:
/// sqrt((1/12) / second moment). The pixel filter adds this disk to each footprint.
template <detail::HasSecondMoment K>
inline constexpr double pixel_filter_width = [] {
    const double square = 1.0 / (12.0 * double(K::second_moment));
    double root = 1.0; // Newton: std::sqrt is not constexpr in C++20
    for (int i = 0; i < 64; ++i)
        root = 0.5 * (root + square / root);
    return root;
}();

/// 3/π (1 − r²)²: smooth to the first derivative at the edge. The default.
/// Source: Silverman 1986; Frisvad et al. 2014, eq. 11.
struct BiweightKernel {
    static constexpr double second_moment = 1.0 / 8;
    template <Scalar T>
    [[nodiscard]] constexpr T operator()(const T& radius2) const {
        const T rest = keep_if(radius2 < T(1), T(T(1) - radius2));
        return T(3) / pi<T> * rest * rest;
    }
    template <Scalar T>
    [[nodiscard]] constexpr T mass_within(const T& radius2) const {
        const T rest = T(1) - radius2;
        return T(1) - rest * rest * rest;
    }
};

/// 2/π (1 − r²).
struct EpanechnikovKernel {
    static constexpr double second_moment = 1.0 / 6;
    template <Scalar T>
    [[nodiscard]] constexpr T operator()(const T& radius2) const {
        return T(2) / pi<T> * keep_if(radius2 < T(1), T(T(1) - radius2));
    }
    template <Scalar T>
    [[nodiscard]] constexpr T mass_within(const T& radius2) const {
        return radius2 * (T(2) - radius2);
    }
};

/// 3/π (1 − r): Jensen's cone with k = 1.
struct ConeKernel {
    static constexpr double second_moment = 3.0 / 20;
    template <Scalar T>
    [[nodiscard]] T operator()(const T& radius2) const {
        return T(3) / pi<T> * keep_if(radius2 < T(1), T(T(1) - sqrt(radius2)));
    }
    template <Scalar T>
    [[nodiscard]] T mass_within(const T& radius2) const {
        return radius2 * (T(3) - T(2) * sqrt(radius2));
    }
};

/// 1/π.
struct UniformKernel {
    static constexpr double second_moment = 1.0 / 4;
    template <Scalar T>
    [[nodiscard]] constexpr T operator()(const T& radius2) const {
        return keep_if(radius2 < T(1), T(T(1) / pi<T>));
    }
    template <Scalar T>
    [[nodiscard]] constexpr T mass_within(const T& radius2) const {
        return radius2;
    }
};

/// A Gaussian of standard deviation 1/3 per axis, cut at the edge of the disk: exp(−9/2 r²) · 9 / (2π (1 −
/// e^(−9/2))).
struct TruncatedGaussianKernel {
    static constexpr double cut = 0.011108996538242306; ///< e^(−9/2), what the untruncated Gaussian has left at r = 1
    static constexpr double second_moment = (1.0 - 5.5 * cut) / (9.0 * (1.0 - cut));
    template <Scalar T>
    [[nodiscard]] T operator()(const T& radius2) const {
        using std::exp;
        return keep_if(radius2 < T(1), T(T(9.0 / (2 * (1.0 - cut))) / pi<T> * exp(T(-4.5) * radius2)));
    }
    template <Scalar T>
    [[nodiscard]] T mass_within(const T& radius2) const {
        using std::exp;
        return (T(1) - exp(T(-4.5) * radius2)) * T(1 / (1.0 - cut));
    }
};

static_assert(Kernel<BiweightKernel> && Kernel<EpanechnikovKernel> && Kernel<ConeKernel> && Kernel<UniformKernel> &&
              Kernel<TruncatedGaussianKernel>);

} // namespace nephroid
