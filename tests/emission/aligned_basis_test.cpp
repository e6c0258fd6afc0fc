// SPDX-License-Identifier: MIT
#include "nephroid/emission/aligned_basis.hpp"

#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/warp.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace nephroid::tests::aligned_basis_test {

namespace {

/// Pairs (normal, direction) over the hemisphere, the last ones all but parallel: at sines from 1e-3 to 1e-20.
template <class V>
struct Pair {
    V normal, direction;
};

template <class V>
Pair<V> pair(std::uint64_t i) {
    using T = scalar_t<V>;
    const RandomSequence random(6);
    const auto at = [&](std::uint32_t d) { return random.sample<T>(i, d); };
    const V normal = sphere_direction<V>(at(0), at(1));
    const Frame<V> frame = frame_about(normal);
    if (i % 2 == 0)
        return {normal, cosine_direction(normal, frame, concentric_disk(at(2), at(3)))};
    const T angle = std::pow(T(10), -3 - 17 * at(2));
    return {normal, normalize(V(normal + angle * (std::cos(6 * at(3)) * frame.u + std::sin(6 * at(3)) * frame.v)))};
}

/// The ellipse's quadratic form D Dᵀ in a plane after a flight: what all pairs of its conjugate radii share.
template <class V>
std::array<scalar_t<V>, 6> ellipse(const AlignedBasis<V>& basis, const V& direction, scalar_t<V> distance,
                                   const V& plane, scalar_t<V> dx, scalar_t<V> dw) {
    const auto flight = transfer(direction, distance, plane);
    REQUIRE(flight.has_value());
    std::array<scalar_t<V>, 6> form{};
    for (const auto& tangent : {Tangent<V>{dx * basis.u, dw * basis.theta}, Tangent<V>{dx * basis.v, dw * basis.phi}}) {
        const V d = (*flight)(tangent).d_position;
        const std::array<scalar_t<V>, 6> products{d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.z * d.x};
        for (std::size_t i = 0; i < 6; ++i)
            form[i] += products[i];
    }
    return form;
}

} // namespace

// Some ten roundings of numbers up to 1. Near the switch u is made from what is left of theta in the plane.
TEST_CASE_TEMPLATE("aligned basis: two orthonormal pairs span the planes across normal and direction", T, float,
                   double) {
    using V = glm::vec<3, T>;
    const T tolerance = 16 * std::numeric_limits<T>::epsilon();
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const auto [normal, direction] = pair<V>(i);
        const AlignedBasis<V> basis = aligned_basis(normal, direction);
        for (const V& unit : {basis.u, basis.v, basis.theta, basis.phi})
            CHECK(std::abs(length(unit) - 1) <= tolerance);
        CHECK(std::abs(dot(basis.u, normal)) <= tolerance);
        CHECK(std::abs(dot(basis.v, normal)) <= tolerance);
        CHECK(std::abs(dot(basis.u, basis.v)) <= tolerance);
        CHECK(std::abs(dot(basis.theta, direction)) <=
              2 * std::sqrt(std::numeric_limits<T>::epsilon()) * tolerance + tolerance);
        CHECK(std::abs(dot(basis.phi, direction)) <= tolerance);
        CHECK(std::abs(dot(basis.theta, basis.phi)) <= tolerance);
    }
}

// Appendix A of the paper. Transferred to a plane, the extent of the source and that of its directions are parallel and
// the same way round; below the switch only to the angle between normal and direction, sqrt(epsilon).
TEST_CASE_TEMPLATE("aligned basis: after the first transfer extent and direction are parallel", T, float, double) {
    using V = glm::vec<3, T>;
    const RandomSequence random(7);
    const T root = std::sqrt(std::numeric_limits<T>::epsilon());
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const auto [normal, direction] = pair<V>(i);
        const AlignedBasis<V> basis = aligned_basis(normal, direction);
        const V plane = sphere_direction<V>(random.sample<T>(i, 0), random.sample<T>(i, 1));
        const T grazing = std::abs(dot(plane, direction));
        if (grazing < T(0.05))
            continue;
        const auto flight = *transfer(direction, T(3), plane);
        const V zero(0);
        for (const auto& [x, w] : {std::pair{basis.u, basis.theta}, std::pair{basis.v, basis.phi}}) {
            const V from_extent = flight({x, zero}).d_position, from_direction = flight({zero, w}).d_position;
            const T scale = length(from_extent) * length(from_direction);
            // A projection magnifies an angle by 1/grazing at most, and cancellation as much again.
            const T sine = length(cross(normal, direction));
            const T angle =
                (sine > T(1.5) * root ? 32 * std::numeric_limits<T>::epsilon() / sine : 2 * root) / (grazing * grazing);
            CHECK(length(cross(from_extent, from_direction)) <= angle * scale);
            CHECK(dot(from_extent, from_direction) > 0);
        }
    }
}

// Along the normal the footprint is a circle of radius dx + t dw before projection. At an angle a from it each length
// changes by a relative a at most, so on both sides of the switch, at sqrt(epsilon), the quadratic forms are the
// circle's to twice that, times 1/cos² = 2 for a plane at 45 degrees.
TEST_CASE_TEMPLATE("aligned basis: both sides of the switch have the same ellipse", T, float, double) {
    using V = glm::vec<3, T>;
    const T root = std::sqrt(std::numeric_limits<T>::epsilon());
    const V normal = normalize(V(1, 2, -3)), across = frame_about(normal).u;
    const V plane = normalize(V(normal + across));
    const T dx = T(0.3), dw = T(0.1), distance = 2, radius = dx + distance * dw;
    // The circle, and what the slanted plane adds along `along`.
    const V along = normalize(V(normal - dot(normal, plane) * plane)), side = cross(plane, along);
    const T stretched = radius / dot(normal, plane);
    const std::array<T, 6> circle{stretched * stretched * along.x * along.x + radius * radius * side.x * side.x,
                                  stretched * stretched * along.y * along.y + radius * radius * side.y * side.y,
                                  stretched * stretched * along.z * along.z + radius * radius * side.z * side.z,
                                  stretched * stretched * along.x * along.y + radius * radius * side.x * side.y,
                                  stretched * stretched * along.y * along.z + radius * radius * side.y * side.z,
                                  stretched * stretched * along.z * along.x + radius * radius * side.z * side.x};
    for (const T factor : {T(0), T(0.5), T(0.99), T(1.01), T(2)}) {
        CAPTURE(factor);
        const V direction =
            normalize(V(normal + factor * root * normalize(V(across + T(0.3) * cross(normal, across)))));
        const auto form = ellipse(aligned_basis(normal, direction), direction, distance, plane, dx, dw);
        for (std::size_t i = 0; i < 6; ++i)
            CHECK(std::abs(form[i] - circle[i]) <= 8 * (factor + T(0.1)) * root * radius * radius);
    }
}

} // namespace nephroid::tests::aligned_basis_test
