// SPDX-License-Identifier: MIT
/// @file  A photon from a chosen point of its light's domain.
#pragma once

#include "nephroid/emission/light.hpp"

#include <array>
#include <cstddef>

namespace nephroid {

namespace detail {
/// A source of samples that always returns 1/2.
struct MiddleSource {
    template <Scalar T>
    [[nodiscard]] T next() {
        return T(0.5);
    }
};

/// A source of samples that returns the coordinates of a point, and then the numbers of another source.
template <std::size_t coordinates, class Rest>
class PointSource {
public:
    PointSource(const std::array<double, coordinates>& point, Rest& rest) : point_(point), rest_(&rest) {}

    template <Scalar T>
    [[nodiscard]] T next() {
        return given_ < coordinates ? T(point_[given_++]) : rest_->template next<T>();
    }

private:
    std::array<double, coordinates> point_;
    std::size_t given_ = 0;
    Rest* rest_;
};
} // namespace detail

/// The photon that a light emits from a point of its domain. It is a smooth function of the point, except at the kinks
/// that the light declares.
///
/// @param light   with a `domain`; not a set of lights, but one of them
/// @param point   as many coordinates as the domain has, each in [0, 1]
/// @param spread  the number of photons that the light's flux is divided by, and their smoothing. The photon's flux
///                times that number is the flux density over the domain's unit square
/// @param extras  a source of samples for the extras (wavelength, time). If left out, each is the middle of its range
///
/// ```cpp
/// const auto corner = nephroid::emit_at(sun, {0.25, 0.75}, nephroid::Spread<float>{1, 1});
/// ```
template <class L, class Extras>
[[nodiscard]] auto emit_at(const L& light, const std::array<double, coordinates_of<L>>& point,
                           const Spread<scalar_t<typename L::vector>>& spread, Extras& extras) {
    static_assert(coordinates_of<L> != 0, "nephroid::emit_at: the light declares no `domain` (emission/light.hpp)");
    detail::PointSource<coordinates_of<L>, Extras> samples(point, extras);
    return light.emit(samples, spread);
}

template <class L>
[[nodiscard]] auto emit_at(const L& light, const std::array<double, coordinates_of<L>>& point,
                           const Spread<scalar_t<typename L::vector>>& spread) {
    detail::MiddleSource middle;
    return emit_at(light, point, spread, middle);
}

} // namespace nephroid
