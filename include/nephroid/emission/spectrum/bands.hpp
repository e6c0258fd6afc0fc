// SPDX-License-Identifier: MIT
/// @file  A flux of several spectral bands.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/vector/scalar.hpp"

#include <array>
#include <concepts>
#include <cstddef>

namespace nephroid {

/// B numbers, one for each band of a spectrum: a flux, or a weight. Any other flux whose bands are read and written as
/// f[i] serves as well.
template <Scalar T, std::size_t B>
struct Bands {
    using value_type = T;

    std::array<T, B> values{};

    constexpr Bands() = default;
    /// The same number in each band.
    explicit constexpr Bands(const T& all) { values.fill(all); }

    template <std::integral I>
    [[nodiscard]] constexpr T& operator[](I band) {
        return values[static_cast<std::size_t>(band)];
    }
    template <std::integral I>
    [[nodiscard]] constexpr const T& operator[](I band) const {
        return values[static_cast<std::size_t>(band)];
    }
    [[nodiscard]] static constexpr std::size_t size() { return B; }

    [[nodiscard]] friend constexpr Bands operator+(Bands a, const Bands& b) {
        for (std::size_t i = 0; i < B; ++i)
            a.values[i] = a.values[i] + b.values[i];
        return a;
    }
    [[nodiscard]] friend constexpr Bands operator*(Bands a, const Bands& b) {
        for (std::size_t i = 0; i < B; ++i)
            a.values[i] = a.values[i] * b.values[i];
        return a;
    }
    [[nodiscard]] friend constexpr Bands operator*(Bands a, const T& factor) {
        for (T& value : a.values)
            value = value * factor;
        return a;
    }
    [[nodiscard]] friend constexpr bool operator==(const Bands&, const Bands&) = default;
};

/// The power is the mean of the bands, as it is for a colour.
template <Scalar T, std::size_t B>
struct flux_traits<Bands<T, B>> {
    [[nodiscard]] static constexpr double power(const Bands<T, B>& flux) {
        double sum = 0;
        for (const T& value : flux.values)
            sum += double(value);
        return sum / double(B);
    }
    [[nodiscard]] static constexpr Bands<T, B> zero() { return {}; }
};

} // namespace nephroid
