// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/quality/reference/ring.hpp"
#include "quality/reference/compare.hpp"

#include <doctest/doctest.h>

namespace nephroid::reference::ring_test {

namespace {

constexpr Ring any{Reflections::any}, one{Reflections::one};
constexpr Film whole(int width, int height) { return {-0.1, 2.1, -1.1, 1.1, width, height}; }

/// Adds a ray that starts at `at` towards `d`, inside or before the mirror; no closed form for the next hit.
void trace(Vector at, Vector d, double flux, Reflections reflections, Image& image, const Film& film) {
    for (int hits = 0;; ++hits) {
        const double a = d.x * d.x + d.y * d.y, b = at.x * d.x + at.y * d.y, c = at.x * at.x + at.y * at.y - 1;
        const double discriminant = b * b - a * c;
        const double t = discriminant > 0 ? (std::sqrt(discriminant) - b) / a : -1; // where it leaves the cylinder
        const Vector hit = at + t * d;
        if (t < 1e-9 || hit.x < 0 || hit.z < 0) {
            if (hits > 0)
                add_flux(image, film, at.x - at.z / d.z * d.x, at.y - at.z / d.z * d.y, flux);
            return;
        }
        if (hit.z > 0.5 || (hits == 1 && reflections == Reflections::one))
            return;
        const Vector n{-hit.x, -hit.y, 0};
        d = d + -2 * dot(d, n) * n;
        at = hit;
    }
}

} // namespace

TEST_CASE("reference ring: the total flux is as known, from closed forms and from the pixels") {
    CHECK(std::abs(ring_flux(any) - 1.428148) < 5e-7); // half a unit of the last digit
    CHECK(std::abs(ring_flux(one) - 1.397197) < 5e-7);
    for (const Ring& r : {any, one})
        for (const int n : {1, 16, 37, 128}) // quadrature to 1e-10 of the light reflected often, and roundings
            CHECK(std::abs(mean(ring(r, whole(n, n))) * 2.2 * 2.2 / ring_flux(r) - 1) < 1e-11);
}

TEST_CASE("reference ring: the mean irradiance in the zoom is as known") {
    for (const Ring& r : {any, one}) // no light that was reflected twice gets there
        CHECK(std::abs(mean(ring(r, {0.1, 0.9, -0.4, 0.4, 64, 64})) - 1.491959) < 5e-7);
}

TEST_CASE("reference ring: no light lands outside the half circle") {
    CHECK(mean(ring(any, {-0.5, 0, -1, 1, 8, 8})) == 0);
    CHECK(mean(ring(any, {1, 2.1, -1, 1, 8, 8})) == 0);
    CHECK(mean(ring(any, {0.72, 1, 0.72, 1, 8, 8})) == 0);
}

// Two million rays over the 1.8 x 2 of the beam: 17000 land on a pixel of 1/8 x 1/8 at irradiance 1, of which a few
// hundred near its outline in the worst case, in practice 10 times fewer; the least pixels get a tenth of that.
TEST_CASE("reference ring: two million traced rays land as computed") {
    const Film film{0, 1, -1, 1, 8, 16};
    const double e = 35 * std::numbers::pi / 180;
    for (const Ring& r : {any, one}) {
        Image image(8 * 16);
        constexpr int n = 2'000'000;
        for (int i = 0; i < n; ++i) {
            const LatticePoint p(i);
            trace({1.8 * p.u - 0.8, 2 * p.v - 1, 0.5}, {std::cos(e), 0, -std::sin(e)}, 3.6 / n, r.reflections, image,
                  film);
        }
        CHECK(std::abs(mean(image) * 2 - ring_flux(r)) < 1e-3);
        CHECK(worst_difference(image, ring(r, film), 0.1) < 0.015);
    }
}

// The midpoint rule in phi errs by about (h / width)^2 / 12 at each of some ten kinks, a chord sweeping over the pixel
// within width = 0.01 or more: h = 1.6e-6 leaves 2e-8. Where the chord lies in the pixel's side its length jumps: h /
// width.
TEST_CASE("reference ring: single pixels agree with a dense sum over the mirror") {
    const double s = 0.01;
    struct Corner {
        double x, y;
    };
    for (const Corner& c : {Corner{0.5, 0.1}, Corner{0.69, -0.11}, Corner{0.8, 0.3}, Corner{0.501, -0.003},
                            Corner{0.707, 0.5}, Corner{0.96, 0.2}, Corner{0.2, 0.97}}) {
        constexpr int n = 2'000'000;
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const double phi = std::numbers::pi * ((i + 0.5) / n - 0.5), px = std::cos(phi), py = std::sin(phi);
            const double dx = 1 - 2 * px * px, dy = -2 * px * py;
            double from = 0, to = (std::min)(detail::ring_reach, 2 * px);
            const double ax = (c.x - px) / dx, bx = (c.x + s - px) / dx, ay = (c.y - py) / dy, by = (c.y + s - py) / dy;
            from = (std::max)({from, (std::min)(ax, bx), (std::min)(ay, by)});
            to = (std::min)({to, (std::max)(ax, bx), (std::max)(ay, by)});
            sum += px * (std::max)(0.0, to - from) * std::numbers::pi / n;
        }
        const double jump = c.x == 0.707 ? 1e-4 : 2e-7; // at phi = pi/4 the chord lies in the pixel's side
        CHECK(std::abs(ring(one, {c.x, c.x + s, c.y, c.y + s, 1, 1})[0] * s * s / sum - 1) < jump);
    }
}

TEST_CASE("reference ring: a pixel is the mean of the pixels it is cut into, on any film") {
    for (const Ring& r : {any, one})
        for (const Film& film : {whole(24, 24), Film{0.1, 0.9, -0.4, 0.4, 40, 40}, Film{0.03, 0.57, -0.94, 0.11, 9, 33},
                                 Film{0.48, 0.52, -0.02, 0.02, 16, 16}, Film{0.45, 0.55, 0.85, 0.9, 8, 8}}) {
            const Film fine{film.x_min, film.x_max, film.y_min, film.y_max, 3 * film.width, 3 * film.height};
            // Arcs stand in for chords within 1/2000 of a pixel's side from the mirror, others for each size of pixel.
            // What they misplace is a small part of the 1/2000 that they bring to a pixel, but for pixels that hardly
            // reach into the light.
            const double tolerance = r.reflections == Reflections::one ? 1e-9 : 2e-5;
            CHECK(worst_difference(averaged(ring(r, fine), fine, 3), ring(r, film)) < tolerance);
        }
}

TEST_CASE("reference ring: the image is symmetric, and the number of threads does not change a bit") {
    const Film film = whole(50, 40);
    const Image image = ring(any, film, nephroid::SerialExecutor());
    CHECK(image == ring(any, film, nephroid::ThreadExecutor(5)));
    Image flipped(image.size());
    for (std::size_t j = 0; j < 40; ++j)
        for (std::size_t i = 0; i < 50; ++i)
            flipped[(39 - j) * 50 + i] = image[j * 50 + i];
    CHECK(worst_difference(flipped, image) < 1e-9); // film.y(j) rounds differently at both ends
}

} // namespace nephroid::reference::ring_test
