// SPDX-License-Identifier: MIT
/// @file  How much of a kernel lies within a radius, for any kernel.
#pragma once

#include "nephroid/footprint/kernel.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

namespace nephroid::detail {

template <class K, class T>
concept KnowsMass = requires(const K kernel, const T radius2) {
    { kernel.mass_within(radius2) } -> std::same_as<T>;
};

/// 2π ∫ k(r²) r dr from 0 to a radius, by Gauss and Legendre's rule of eight points: exact for kernels that are
/// polynomials of r up to degree 14.
template <Scalar T, class K>
[[nodiscard]] T mass_by_quadrature(const K& kernel, T radius) {
    constexpr std::array<double, 4> nodes{0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                                          0.96028985649753623};
    constexpr std::array<double, 4> weights{0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                            0.10122853629037626};
    T sum(0);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const double node : {-nodes[i], nodes[i]}) {
            const T r = T(0.5) * radius * T(1 + node);
            sum = sum + T(weights[i]) * kernel(square(r)) * r;
        }
    return pi<T> * radius * sum;
}

/// ∫ k over the disk of a squared radius, in units of the kernel's own radius: 0 at 0, and 1 from 1 on.
template <Scalar T, class K>
[[nodiscard]] T mass_within(const K& kernel, T radius2) {
    const T within = (std::min)(radius2, T(1));
    if constexpr (KnowsMass<K, T>)
        return kernel.mass_within(within);
    else
        return (std::min)(T(1), mass_by_quadrature(kernel, T(sqrt(within))));
}

} // namespace nephroid::detail
