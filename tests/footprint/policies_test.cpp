// SPDX-License-Identifier: MIT
#include "nephroid/footprint/policies.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::policies_test {

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// Semi-axes of these lengths in a tilted plane, as two vectors at the angle t along the ellipse: conjugate, not
/// orthogonal.
template <class T>
Ellipse<Vec<T>> skewed(T major, T minor, T t = T(0.7)) {
    const Vec<T> normal{T(2) / T(3), T(-1) / T(3), T(2) / T(3)};
    const auto [u, v] = frame_about(normal);
    const T c = std::cos(t), s = std::sin(t);
    return {(c * major) * u + (s * minor) * v, (-s * major) * u + (c * minor) * v, normal};
}

template <class T>
void check_radii(const Ellipse<Vec<T>>& e, T major, T minor) {
    const auto sigma = radii(e);
    CHECK(std::abs(sigma.major - major) <= 16 * epsilon<T> * major);
    // The skewed vectors of a needle are as long as its major axis: rounding changes its width by that much.
    CHECK(std::abs(sigma.minor - minor) <= 16 * epsilon<T> * (major + minor));
}

/// Takes what it gets, and says so.
struct KeepAll {
    template <Vector3 V>
    Verdict operator()(Ellipse<V>&, scalar_t<V>) const {
        return Verdict::kept;
    }
};
struct SaysNothing {
    template <Vector3 V>
    void operator()(Ellipse<V>&, scalar_t<V>) const {}
};

template <class V>
constexpr bool all_are_policies =
    FootprintPolicy<DiscardCollapsed, V>&& FootprintPolicy<BoundMajorRadius, V>&& FootprintPolicy<KeepAll, V>;
static_assert(all_are_policies<glm::vec3> && all_are_policies<glm::dvec3>);
static_assert(!FootprintPolicy<SaysNothing, glm::vec3>);
static_assert(!FootprintPolicy<int, glm::vec3>);
static_assert(!FootprintPolicy<KeepAll, int>);

} // namespace

TEST_CASE_TEMPLATE("DiscardCollapsed: discards footprints without area and changes no other", T, float, double) {
    const DiscardCollapsed policy;
    for (const T minor : {T(1), T(1e-3), T(1e-20)}) {
        Ellipse<Vec<T>> e{{1, 0, 0}, {0, minor, 0}, {0, 0, 1}};
        CHECK(policy(e, T(1)) == Verdict::kept);
        CHECK(e.a == Vec<T>{1, 0, 0});
        CHECK(e.b == Vec<T>{0, minor, 0});
        e.normal = -e.normal; // the sign of the area says how the tangents are turned, nothing else
        CHECK(policy(e, T(1)) == Verdict::kept);
    }
    Ellipse<Vec<T>> point{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}, line{{1, 1, 0}, {2, 2, 0}, {0, 0, 1}};
    CHECK(policy(point, T(1)) == Verdict::discarded);
    CHECK(policy(line, T(1)) == Verdict::discarded);
    // Its inverse overflows: no filter matrix.
    Ellipse<Vec<T>> least{{1, 0, 0}, {0, std::numeric_limits<T>::denorm_min(), 0}, {0, 0, 1}};
    CHECK(policy(least, T(1)) == Verdict::discarded);
}

TEST_CASE_TEMPLATE("BoundMajorRadius: shortens along the major axis and keeps the minor one", T, float, double) {
    for (const T t : {T(0), T(0.7), T(1.5), T(2.9)}) {
        const auto before = skewed<T>(T(50), T(0.5), t);
        auto e = before;
        CHECK(BoundMajorRadius{2}(e, T(5)) == Verdict::bounded);
        check_radii(e, T(10), T(0.5));
        // The frame's u is still the major axis: nothing has been turned. Off by epsilon 50 where it was rounded.
        const auto [u, v] = frame_about(e.normal);
        const T uv = dot(u, e.a) * dot(v, e.a) + dot(u, e.b) * dot(v, e.b);
        CHECK(std::abs(uv) <= 64 * epsilon<T> * 50 * 10);
    }
    const auto inside = skewed<T>(T(9.99), T(0.5));
    auto e = inside;
    CHECK(BoundMajorRadius{2}(e, T(5)) == Verdict::kept);
    CHECK(e.a == inside.a);
    CHECK(e.b == inside.b);
}

TEST_CASE_TEMPLATE("BoundMajorRadius: shortens both radii of a footprint that is too long in all directions", T, float,
                   double) {
    for (const T minor : {T(50), T(49), T(10.5)}) {
        auto e = skewed<T>(T(50), minor);
        CHECK(BoundMajorRadius{2}(e, T(5)) == Verdict::bounded);
        check_radii(e, T(10), T(10));
    }
}

// A ray that grazes its receiver makes these: the squares of such lengths, and the squares of those, overflow before
// they do.
TEST_CASE_TEMPLATE("BoundMajorRadius: bounds the longest possible footprints", T, float, double) {
    for (const int power : std::is_same_v<T, float> ? std::array{20, 40, 60} : std::array{20, 100, 200}) {
        const T huge = std::ldexp(T(1), power);
        CAPTURE(power);
        Ellipse<Vec<T>> e{{T(3) / 5 * huge, T(4) / 5 * huge, 0}, {0, 1, 0}, {0, 0, 1}};
        CHECK(BoundMajorRadius{}(e, T(5)) == Verdict::bounded);
        const auto sigma = radii(e);
        CHECK(sigma.major <= T(5) * (1 + 16 * epsilon<T>));
        CHECK(isfinite(area_scale(e)));
    }
}

TEST_CASE_TEMPLATE("BoundMajorRadius: there is no bound if the map has no extent", T, float, double) {
    auto e = skewed<T>(T(50), T(0.5));
    CHECK(BoundMajorRadius{}(e, T(0)) == Verdict::kept);
    check_radii(e, T(50), T(0.5));
}

} // namespace nephroid::tests::policies_test
