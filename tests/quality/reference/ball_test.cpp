// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/quality/reference/ball.hpp"
#include "quality/reference/compare.hpp"
#include "support/is_sanitized.hpp"

#include <doctest/doctest.h>

namespace nephroid::reference::ball_test {

using nephroid::tests::is_sanitized;

namespace {

constexpr Ball collimated{BallLight::collimated, false}, collimated_fresnel{BallLight::collimated, true};
constexpr Ball point{BallLight::point, false}, point_fresnel{BallLight::point, true};
constexpr double pi = std::numbers::pi;
const double inf = std::numeric_limits<double>::infinity();

/// Adds a ray from `at` along the unit vector `d`, refracted in space by Snell's law for vectors.
void trace(const Ball& ball, Vector at, Vector d, double flux, Image& image, const Film& film) {
    const Vector centre{0, 0, 1.25};
    double passed = 1;
    for (const double eta : {1 / 1.5, 1.5}) {
        const Vector m = at + -1 * centre;
        const double b = dot(m, d), discriminant = b * b - dot(m, m) + 1;
        if (discriminant <= 0)
            return;
        at = at + (-b + (eta < 1 ? -1 : 1) * std::sqrt(discriminant)) * d;
        d = refract(d, (eta < 1 ? 1 : -1) * (at + -1 * centre), eta, passed);
    }
    if (d.z < 0)
        add_flux(image, film, at.x - at.z / d.z * d.x, at.y - at.z / d.z * d.y, ball.fresnel ? flux * passed : flux);
}

/// The part of the circle of radius r about the axis in the quadrant x < X, y < Y, in radians.
double angle_below(double r, double x, double y) {
    const auto half = [r](double v) { return std::acos((std::clamp)(v / r, -1.0, 1.0)); };
    // x < X: the circle less an arc of +-a about 0. y < Y: less an arc of +-b about pi/2.
    const double a = half(x), b = half(y);
    const double overlap = (std::max)(0.0, (std::min)(a, pi / 2 + b) - (std::max)(-a, pi / 2 - b)) +
                           (std::max)(0.0, (std::min)(a, -1.5 * pi + b) - (std::max)(-a, -1.5 * pi - b));
    return 2 * pi - 2 * a - 2 * b + overlap;
}

} // namespace

TEST_CASE("reference ball: the means over the film are as known") {
    const Film film{-0.5, 0.5, -0.5, 0.5, 64, 64}; // tolerances: half a unit of the last digit
    CHECK(std::abs(mean(ball(collimated, film)) - 2.910319) < 5e-7);
    CHECK(std::abs(mean(ball(collimated_fresnel, film)) - 2.535979) < 5e-7);
    CHECK(std::abs(mean(ball(point, film)) - 3.157092) < 5e-7);
    CHECK(std::abs(mean(ball(point_fresnel, film)) - 2.660010) < 5e-7);
}

TEST_CASE("reference ball: the folds lie at the known radii, with or without Fresnel loss") {
    CHECK(std::abs(ball_fold_radius(collimated) - 0.0549) < 5e-5);
    CHECK(std::abs(ball_fold_radius(point) - 0.2293) < 5e-5);
    CHECK(ball_fold_radius(point) == ball_fold_radius(point_fresnel));
}

// Collimated: rays turned by less than 90 degrees come down, i - t < 45 degrees, tan t = sin 45 / (1.5 - cos 45).
// Point: all rays that meet the ball come down, a cone with sin = 1/4.
TEST_CASE("reference ball: the total flux follows from the last ray that comes down") {
    const double t = std::atan(std::sqrt(0.5) / (1.5 - std::sqrt(0.5))), radius = 1.5 * std::sin(t);
    CHECK(std::abs(ball_flux(collimated, inf) - pi * radius * radius) < 1e-13);
    CHECK(std::abs(ball_flux(point, inf) - 32 * pi * (1 - std::sqrt(15.0 / 16))) < 1e-13);
    CHECK(std::abs(ball_flux(collimated, 1e7) / ball_flux(collimated, inf) - 1) < 1e-7);
    CHECK(std::abs(ball_flux(point_fresnel, 2) - ball_flux(point_fresnel, inf)) < 1e-13); // the lit disk ends at 1.7
    CHECK(ball_flux(collimated, 0) < 1e-13);
}

TEST_CASE("reference ball: the pixels of a film around all light add up to all light") {
    for (const Ball& b : {point, point_fresnel})
        for (const int n : {1, 2, 33, 100})
            CHECK(std::abs(mean(ball(b, {-1.8, 1.9, -2, 1.7, n, n})) * 3.7 * 3.7 / ball_flux(b, inf) - 1) < 1e-12);
}

// As in the other brute force tests: 2 million rays, of which thousands lie near the outlines of pixels in the worst
// case, and in practice 20 times fewer. The least pixels get 1/40 of the mean.
TEST_CASE("reference ball: two million refracted rays land as computed" * doctest::skip(is_sanitized)) {
    const Film film{-0.5, 0.5, -0.5, 0.5, 8, 8};
    for (const Ball& b : {collimated, collimated_fresnel, point, point_fresnel}) {
        Image image(64);
        constexpr int n = 2'000'000;
        for (int i = 0; i < n; ++i) {
            const LatticePoint p(i);
            if (b.source == BallLight::collimated) {
                trace(b, {2 * p.u - 1, 2 * p.v - 1, 9}, {0, 0, -1}, 4.0 / n, image, film);
            } else {
                const double cone = 1 - std::sqrt(15.0 / 16), c = 1 - cone * p.u, s = std::sqrt(1 - c * c);
                const Vector d{s * std::cos(2 * pi * p.v), s * std::sin(2 * pi * p.v), -c};
                trace(b, {0, 0, 5.25}, d, 32 * pi * cone / n, image, film);
            }
        }
        CHECK(worst_difference(image, ball(b, film), 0.1) < 0.01);
    }
}

// Rings of light, each landing on a circle of which the pixel holds a known arc. Where a circle begins to touch a side
// the arc grows like a square root, so n rings are wrong by n^(-3/2) of the pixel's own share of them: 1e-6 for 1e6
// rings.
TEST_CASE("reference ball: single pixels agree with a sum over circles on the floor") {
    for (const Ball& b : {collimated, point_fresnel}) {
        const detail::BallMap map(b);
        const double f = map.fold_radius();
        const Film films[] = {{-0.01, 0.02, -0.015, 0.01, 1, 1},   {0, 0.01, 0, 0.01, 1, 1},
                              {f - 0.01, f + 0.01, 0, 0.02, 1, 1}, {f - 0.03, f, -0.04, 0.01, 1, 1},
                              {0.3, 0.33, -0.4, -0.37, 1, 1},      {-1, 1, -1.2, 1.7, 1, 1}};
        for (const Film& film : films) {
            constexpr int n = 200'000;
            double sum = 0;
            for (int k = 0; k < n; ++k) {
                const double i = map.last() * (k + 0.5) / n, r = std::abs(map.landing(i)), s = std::sin(i);
                const double passed = b.fresnel ? std::pow(detail::transmittance(s, 1.5), 2) : 1;
                const double flux = b.source == BallLight::collimated ? 1 : 1 / std::sqrt(1 - s * s / 16);
                const double angle = angle_below(r, film.x_max, film.y_max) - angle_below(r, film.x_min, film.y_max) -
                                     angle_below(r, film.x_max, film.y_min) + angle_below(r, film.x_min, film.y_min);
                sum += angle * passed * flux * s * std::cos(i) * map.last() / n;
            }
            const double pixel = ball(b, film)[0] * (film.x_max - film.x_min) * (film.y_max - film.y_min);
            CHECK(std::abs(pixel / sum - 1) < 2e-5);
        }
    }
}

// A pixel's flux is a difference of fluxes of order 1 over angles of order 0.01: 1e-14 of them are 1e-12 of it.
TEST_CASE("reference ball: a pixel is the mean of the pixels it is cut into, on any film") {
    for (const Ball& b : {collimated, collimated_fresnel, point, point_fresnel})
        for (const Film& film :
             {Film{-0.5, 0.5, -0.5, 0.5, 32, 32}, Film{-0.5, 0.5, -0.5, 0.5, 33, 33}, Film{-1.7, 0.4, 0.2, 2.3, 20, 31},
              Film{-0.06, 0.06, 0.04, 0.07, 16, 16}, Film{-1e-3, 1e-3, -1e-3, 1e-3, 9, 8}}) {
            const Film fine{film.x_min, film.x_max, film.y_min, film.y_max, 3 * film.width, 3 * film.height};
            CHECK(worst_difference(averaged(ball(b, fine), fine, 3), ball(b, film)) < 1e-9);
        }
}

TEST_CASE("reference ball: the image is symmetric, and the number of threads does not change a bit") {
    const Film film{-0.5, 0.5, -0.5, 0.5, 40, 40};
    const Image image = ball(collimated_fresnel, film, nephroid::SerialExecutor());
    CHECK(image == ball(collimated_fresnel, film, nephroid::ThreadExecutor(5)));
    Image transposed(image.size());
    for (std::size_t j = 0; j < 40; ++j)
        for (std::size_t i = 0; i < 40; ++i)
            transposed[i * 40 + j] = image[j * 40 + i];
    CHECK(worst_difference(transposed, image) < 1e-11);
}

} // namespace nephroid::reference::ball_test
