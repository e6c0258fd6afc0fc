// SPDX-License-Identifier: MIT
#include "nephroid/image/neighbour_tangents.hpp"

#include "image/wave_scene.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/image/trace_buffer.hpp"
#include "nephroid/splat/splat_photons.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace nephroid::tests::neighbour_tangents_test {

namespace {

/// The error of each photon's tangents against differences of the closed form, over the length of the longer one.
[[nodiscard]] std::vector<double> errors_of_tangents(std::size_t side) {
    const PlainWave<double> scene;
    const auto traced = trace_buffers(scene, sun_over_square<double>(), {.columns = side, .rows = side});
    const auto photons = neighbour_tangents(traced.buffers[0]);
    REQUIRE(photons.deposits.size() == side * side);
    std::vector<double> errors;
    const double h = 1e-5, full = 2 / std::sqrt(pi<double>) / double(side);
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
            const double x = (double(i) + 0.5) / double(side), y = (double(j) + 0.5) / double(side);
            const glm::dvec2 u = (landing(x + h, y, 0.04) - landing(x - h, y, 0.04)) * (full / (2 * h));
            const glm::dvec2 v = (landing(x, y + h, 0.04) - landing(x, y - h, 0.04)) * (full / (2 * h));
            const auto& d = photons.deposits[j * side + i].d_position;
            const double size = (std::max)(glm::length(u), glm::length(v));
            errors.push_back((std::max)(glm::length(glm::dvec2(d[0]) - u), glm::length(glm::dvec2(d[1]) - v)) / size);
        }
    std::sort(errors.begin(), errors.end());
    return errors;
}

} // namespace

TEST_CASE("neighbour tangents: they are the differentials of a wave to second order in the grid's step") {
    // The difference's error is a sixth of the third derivative times the step squared, so it is quartered.
    const auto coarse = errors_of_tangents(71), middle = errors_of_tangents(141);
    const auto median = [](const std::vector<double>& e) { return e[e.size() / 2]; };
    CHECK(median(coarse) / median(middle) > 3.5);
    CHECK(median(coarse) / median(middle) < 4.5);
    // (4π)² (1/141)² / 6 = 0.13% is the error of a difference of sin(4π x); most photons' maps bend less than that.
    CHECK(median(middle) < 1.3e-3);
}

TEST_CASE("neighbour tangents: a scene without curvature and without ids draws a wave through the splatter") {
    const PlainWave<float> scene;
    const auto traced = trace_buffers(scene, sun_over_square<float>(), {.columns = 71, .rows = 71});
    CHECK(!traced.buffers[0].has_surfaces());
    const auto photons = neighbour_tangents(traced.buffers[0]);
    CHECK(photons.isolated == 0);
    std::vector<Vertex<glm::vec3>> vertices;
    const int side = 64;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            vertices.push_back({{(float(i) + 0.5f) / side, (float(j) + 0.5f) / side, 0}, {0, 0, 1}});
    const EyePathMap<glm::vec3> map(vertices, &Vertex<glm::vec3>::position, &Vertex<glm::vec3>::normal);
    auto sums = nephroid::sums<float>(map);
    const Statistics account = splat(photons.deposits, sums, {.smoothing = 2.5});
    CHECK(account.accounted_flux() == doctest::Approx(1).epsilon(1e-5));
    // What leaves the square's sides does not come back, so the middle is compared: its mean is that of the pattern, 1,
    // as it has whole periods (1/2 along x, 1 along y, so the columns' means are that of all).
    double sum = 0;
    int count = 0;
    sums.for_each([&](std::size_t i, float e) {
        if (i / side >= 16 && i / side < 48 && i % side >= 16 && i % side < 48)
            sum += double(e), ++count;
    });
    CHECK(sum / count == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("neighbour tangents: they do not depend on the number of threads") {
    const PlainWave<float> scene;
    const auto with = [&](unsigned threads) {
        ThreadExecutor executor(threads);
        const auto traced = trace_buffers(scene, sun_over_square<float>(), {.columns = 40, .rows = 30}, {}, executor);
        return neighbour_tangents(traced.buffers[0], executor).deposits;
    };
    const auto one = with(1), three = with(3);
    REQUIRE(one.size() == three.size());
    CHECK(std::memcmp(one.data(), three.data(), one.size() * sizeof one[0]) == 0);
}

namespace {
/// A floor with one stripe or square of surface, below a pane that bends nothing: what falls beside it flies on.
struct Patchy {
    using Vec3 = glm::dvec3;
    static constexpr bool scatters_by_chance = false;
    double x_min, x_max, y_min, y_max;
    struct PlainHit {
        double distance;
        Vec3 geometric_normal;
        double position_error;
        bool is_pane;
    };
    [[nodiscard]] std::optional<PlainHit> intersect(const Vec3& o, const Vec3& d, double t_min, double t_max) const {
        if (const double to_pane = (1 - o.z) / d.z; to_pane > t_min && to_pane < t_max)
            return PlainHit{to_pane, {0, 0, 1}, 1e-12, true};
        const double t = -o.z / d.z;
        const Vec3 p = o + t * d;
        if (t > t_min && t < t_max && p.x > x_min && p.x < x_max && p.y > y_min && p.y < y_max)
            return PlainHit{t, {0, 0, 1}, 1e-12, false};
        return std::nullopt;
    }
    [[nodiscard]] Scattering<double, double> scatter(const PlainHit& hit, const Vec3&, auto&) const {
        return hit.is_pane ? Scattering<double, double>::refract(1, 1) : Scattering<double, double>::deposit();
    }
};
} // namespace

TEST_CASE("neighbour tangents: a photon without neighbours along one axis is a square, one without any as if unbent") {
    const auto sun = sun_over_square<double>();
    const double full = 2 / std::sqrt(pi<double>);
    // On a grid of 10 × 5 cells the one column from 0.1 to 0.2.
    const auto column = trace_buffers(Patchy{0.1, 0.2, 0, 1}, sun, {.columns = 10, .rows = 5});
    const auto strip = neighbour_tangents(column.buffers[0]);
    REQUIRE(strip.deposits.size() == 5);
    CHECK(strip.one_axis == 5);
    CHECK(strip.isolated == 0);
    for (const auto& photon : strip.deposits) {
        CHECK(glm::length(photon.d_position[1] - glm::dvec3(0, full / 5, 0)) < 1e-12);
        CHECK(glm::length(photon.d_position[0] - glm::dvec3(full / 5, 0, 0)) < 1e-12);
    }
    const auto one = trace_buffers(Patchy{0.1, 0.2, 0.4, 0.6}, sun, {.columns = 10, .rows = 5});
    const auto alone = neighbour_tangents(one.buffers[0]);
    REQUIRE(alone.deposits.size() == 1);
    CHECK(alone.isolated == 1);
    CHECK(glm::length(alone.deposits[0].d_position[0] - glm::dvec3(full / 10, 0, 0)) < 1e-12);
    CHECK(glm::length(alone.deposits[0].d_position[1] - glm::dvec3(0, full / 5, 0)) < 1e-12);
}

} // namespace nephroid::tests::neighbour_tangents_test
