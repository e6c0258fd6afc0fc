// SPDX-License-Identifier: MIT
/// @file  The response: what an eye path vertex makes of light from a direction.
#pragma once

#include "nephroid/emission/flux.hpp"

#include <concepts>
#include <cstddef>

namespace nephroid {

/// The response of diffuse surfaces, which does not depend on where light comes from. The sums are irradiance; the
/// caller multiplies them by throughput · albedo / π.
struct Irradiance {};

/// Any other response: response(vertex index, direction of the photon's flight) returns a factor for the photon's
/// irradiance, which is the BRDF f_r(x, −ω_p, ω) times the path's throughput. The sums are then radiance. Called
/// from several threads at once.
///
/// ```cpp
/// auto sums = nephroid::sums<Colour>(map, [&](std::size_t vertex, const Vec3& direction) {
///     return vertices[vertex].throughput * brdf(vertices[vertex], -direction);
/// });
/// ```
template <class R, class V, class F>
concept Response = std::same_as<R, Irradiance> ||
    requires(const R response, std::size_t vertex, const V& direction, const F& flux) {
    { (flux * response(vertex, direction)) } -> std::convertible_to<F>;
};

namespace detail {
template <class R, class V, class F>
consteval bool explain_response() {
    static_assert(Response<R, V, F>,
                  "nephroid: the response cannot be called as response(std::size_t vertex, const V& direction) const "
                  "-> a factor that the flux can be multiplied by (receiver/response.hpp)");
    return false;
}

template <class R, class V, class F>
concept MustRespond = Response<R, V, F> || explain_response<R, V, F>();
} // namespace detail

} // namespace nephroid
