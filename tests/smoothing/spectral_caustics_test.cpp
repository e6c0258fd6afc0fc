// SPDX-License-Identifier: MIT
// Light of all wavelengths to second order, against pictures of one wavelength each.
#include "nephroid/emission/spectrum/spectral.hpp"
#include "support/glass_ball.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::tests::spectral_caustics_test {

namespace {

using V = glm::vec3;
constexpr std::size_t bands = 6;
using Six = Bands<float, bands>;

/// A ball of a glass with an Abbe number of about 10, so that colours part.
struct Ball : GlassBall<V, Six> {
    struct Answer {
        Event event;
        Six weight;
        float eta, d_eta;
    };
    static constexpr double a = 1.4, b = 40000;

    template <class Sampler, class Light>
    Answer scatter(const Hit& hit, const V& direction, Sampler&, const Light& light) const {
        const double l = light.wavelength, n = a + b / (l * l), slope = -2 * b / (l * l * l);
        const bool enters = dot(direction, hit.geometric_normal) < 0;
        return {hit.surface == 0 ? Event::deposit : Event::refract, Six(1), float(enters ? 1 / n : n),
                float(enters ? -slope / (n * n) : slope)};
    }
};

constexpr int rows = 48;

struct Receiver {
    Floor<V> vertices = floor_of<V>(rows, 0.9);
    EyePathMap<V> map = map_of(vertices);
};

template <class F>
DirectionalLight<V, F> sun(const F& irradiance) {
    return DirectionalLight<V, F>(
        {.direction = {0.25f, 0, -1}, .irradiance = irradiance, .patch = BoundingSphere<V>{{0, 0, 1.5f}, 0.9f}});
}

/// rms(a − b) over the mean of b, over all bands.
double relative_error(const std::vector<Six>& a, const std::vector<Six>& b) {
    double squares = 0, mean = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < bands; ++k) {
            squares += square(double(a[i][k]) - double(b[i][k]));
            mean += double(b[i][k]);
        }
    const double n = double(a.size() * bands);
    return std::sqrt(squares / n) / (mean / n);
}

template <class... Arguments>
std::vector<Six> spectral_picture(const Receiver& receiver, const PhotonPass& pass, const Arguments&... arguments) {
    auto sums = nephroid::sums<Six>(receiver.map);
    const Ball ball{{.tint = Six(1)}};
    const Statistics account = caustics(ball, Spectral(sun(Six(1)), EqualBands<bands>{}), sums, pass, arguments...);
    CHECK(std::abs(account.accounted_flux() / account.emitted.flux - 1) < 1e-6);
    std::vector<Six> picture(receiver.vertices.size());
    sums.for_each([&](std::size_t i, const Six& e) { picture[i] = e; });
    return picture;
}

/// Each band from photons of four of its wavelengths.
std::vector<Six> truth(const Receiver& receiver, std::uint64_t photons) {
    std::vector<Six> picture(receiver.vertices.size());
    for (std::size_t k = 0; k < 4 * bands; ++k) {
        const double wavelength = 400 + 300.0 / bands * (double(k) + 0.5) / 4;
        auto sums = nephroid::sums<float>(receiver.map);
        const GlassBall<V, float> ball{.index = float(Ball::a + Ball::b / square(wavelength)), .tint = 1};
        (void)caustics(ball, sun(0.25f), sums, {.count = photons});
        sums.for_each([&](std::size_t i, float e) { picture[i][k / 4] += e; });
    }
    return picture;
}

} // namespace

// 3,000 photons of all wavelengths against 24 × 6,000 of one each. Without dispersion colours would all lie together.
TEST_CASE("spectral caustics: each band is as a picture of its own wavelengths") {
    const Receiver receiver;
    const std::vector<Six> exact = truth(receiver, 6000);
    const double second = relative_error(spectral_picture(receiver, {.count = 3000}), exact);
    const double first =
        relative_error(spectral_picture(receiver, {.count = 3000, .smoothing = 6}, Published{}), exact);
    std::vector<Six> white = exact;
    for (Six& pixel : white)
        pixel = Six(float(flux_traits<Six>::power(pixel)));
    const double grey = relative_error(white, exact);
    CAPTURE(grey); // 1.7
    CHECK(second < 0.1 * grey);
    CHECK(first < 0.15 * grey);
}

} // namespace nephroid::tests::spectral_caustics_test
