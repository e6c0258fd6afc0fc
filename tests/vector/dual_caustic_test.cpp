// SPDX-License-Identifier: MIT
// The library differentiated: a scalar that is a dual number goes through the lamp, the walk, the map and the splats,
// and comes out as the irradiance's derivative by a parameter of the scene.
#include "support/foreign_vectors.hpp"
#include "support/glass_ball.hpp"

#include "nephroid/vector/dual.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::tests::dual_caustic_test {

using Number = Dual<double>;

namespace {

template <class T>
using Ball = tests::GlassBall<foreign::Plain<T>, T>;

/// Plain splats: shapes and shifts that photons choose for each other are constants to a dual number
/// (second_order_test.cpp), and differences would see them change.
template <class T>
[[nodiscard]] std::vector<T> caustic_of(const Ball<T>& scene, const T& sun) {
    return tests::caustic_of<Published>(scene, sun);
}

/// Checks the derivative by a parameter that is `at` in the scene, which a function makes from it.
template <class MakeScene>
void check_derivative(double at, const MakeScene& scene) {
    const std::vector<Number> caustic = caustic_of(scene(Number::parameter(at)), Number(1));
    constexpr double h = 1e-6; // about the cube root of epsilon: a central difference's best
    const std::vector<double> here = caustic_of(scene(at), 1.0), above = caustic_of(scene(at + h), 1.0),
                              below = caustic_of(scene(at - h), 1.0);
    double largest = 0, furthest = 0, change = 0, brightest = 0;
    for (std::size_t i = 0; i < caustic.size(); ++i) {
        const double difference = (above[i] - below[i]) / (2 * h);
        largest = (std::max)(largest, std::abs(difference));
        brightest = (std::max)(brightest, here[i]);
        furthest = (std::max)(furthest, std::abs(caustic[i].derivative() - difference));
        change = (std::max)(change, std::abs(caustic[i].value() - here[i]));
    }
    CHECK(largest > 1); // it depends on the parameter
    // The difference is off by some 10 roundings of the brightest sum over h, 1e-7 of 300 together with h times the
    // jumps of the kernel's second derivative at its edge; 1e-10 of it is what was seen.
    CHECK(furthest <= 1e-7 * largest);
    // The values themselves are made by the same operations in the same order but for the products' fused ones.
    CHECK(change <= 1e-12 * brightest);
}

} // namespace

TEST_CASE("dual numbers: a caustic's derivative by the index of refraction is that of differences") {
    check_derivative(1.5, []<class T>(const T& index) { return Ball<T>{.index = index, .tint = T(0.9)}; });
}

TEST_CASE("dual numbers: a caustic's derivative by the ball's height is that of differences") {
    check_derivative(1.5, []<class T>(const T& height) { return Ball<T>{.height = height, .tint = T(0.9)}; });
}

// The light's flux is multiplied by it twice, so that the derivative is known: 2 E / tint.
TEST_CASE("dual numbers: a caustic's derivative by the glass's tint is twice the irradiance over the tint") {
    const double tint = 0.75;
    const auto caustic = caustic_of(Ball<Number>{.tint = Number::parameter(tint)}, Number(1));
    double furthest = 0, brightest = 0;
    for (const Number& e : caustic) {
        furthest = (std::max)(furthest, std::abs(e.derivative() - 2 * e.value() / tint));
        brightest = (std::max)(brightest, e.value());
    }
    CHECK(brightest > 1);
    CHECK(furthest <= 1e-13 * brightest); // some hundred parts are summed up, each of a few roundings
}

} // namespace nephroid::tests::dual_caustic_test
