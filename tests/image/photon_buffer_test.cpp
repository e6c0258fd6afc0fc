// SPDX-License-Identifier: MIT
#include "nephroid/image/photon_buffer.hpp"

#include "image/wave_scene.hpp"
#include "nephroid/emission/light/disk.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/image/trace_buffer.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace nephroid::tests::photon_buffer_test {

TEST_CASE("photon buffer: its nodes stand for the whole chart, in centres and at corners") {
    for (const NodePlaces places : {NodePlaces::centres, NodePlaces::corners}) {
        const auto traced = trace_buffers(PlainWave<double>{}, sun_over_square<double>(), {7, 4, places});
        const auto& buffer = traced.buffers[0];
        double area = 0, middle = 0;
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t i = 0; i < 7; ++i) {
                area += buffer.area(i, j);
                middle += buffer.area(i, j) * buffer.u(i);
            }
        CHECK(area == doctest::Approx(1));
        CHECK(middle == doctest::Approx(0.5)); // symmetric
        CHECK(buffer.u(0) == doctest::Approx(places == NodePlaces::corners ? 0 : 0.5 / 7));
        CHECK(buffer.v(3) == doctest::Approx(places == NodePlaces::corners ? 1 : 3.5 / 4));
    }
}

TEST_CASE("photon buffer: each node is the photon of its place, and the account closes") {
    const std::size_t columns = 13, rows = 9;
    const auto traced = trace_buffers(PlainWave<double>{}, sun_over_square<double>(), {columns, rows});
    const auto& buffer = traced.buffers[0];
    CHECK(traced.without_charts == 0);
    CHECK(buffer.by_chance() == 0);
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i) {
            const auto ends = buffer.ends(i, j);
            REQUIRE(ends.size() == 1);
            const glm::dvec2 at = landing(buffer.u(i), buffer.v(j), 0.04);
            // A few roundings of a path of three points of size one.
            CHECK(std::abs(ends[0].position.x - at.x) < 1e-13);
            CHECK(std::abs(ends[0].position.y - at.y) < 1e-13);
        }
    const Statistics& account = buffer.account();
    CHECK(account.emitted.flux == doctest::Approx(1).epsilon(1e-14));
    CHECK(account.accounted_flux() + buffer.landed() == doctest::Approx(account.emitted.flux).epsilon(1e-14));
    CHECK(buffer.bytes() == columns * rows * (12 + sizeof(buffer.ends(0, 0)[0])));
}

TEST_CASE("photon buffer: what misses the scene escapes, and has no end") {
    struct Nothing : PlainWave<double> {
        [[nodiscard]] std::optional<PlainHit> intersect(const Vec3&, const Vec3&, double, double) const {
            return std::nullopt;
        }
    };
    const auto traced = trace_buffers(Nothing{}, sun_over_square<double>(), {3, 3});
    CHECK(traced.buffers[0].ends(1, 1).empty());
    CHECK(traced.buffers[0].landed() == 0);
    CHECK(traced.buffers[0].account()[Fate::escaped].flux == doctest::Approx(1));
}

TEST_CASE("photon buffer: a lamp with an area has a buffer for each of its points, and no light twice") {
    const DiskLight<glm::dvec3, double> disk({.centre = {0, 0, 4},
                                              .normal = {0, 0, -1},
                                              .radius = 0.1,
                                              .radiance = 1,
                                              .target = BoundingSphere<glm::dvec3>{{0, 0, 1}, 0.5}});
    const auto traced =
        trace_buffers(PlainWave<double>{}, disk, {65, 65, NodePlaces::corners}, {}, SerialExecutor{}, 4);
    REQUIRE(traced.buffers.size() % 4 == 0);
    double emitted = 0;
    for (const auto& buffer : traced.buffers)
        emitted += buffer.account().emitted.flux;
    // Cells that the target's rim crosses are in or out: 4 · 65 of 65² cells, of which the errors mostly cancel.
    CHECK(emitted == doctest::Approx(disk.power()).epsilon(0.02));
}

TEST_CASE("photon buffer: a grid without cells is refused") {
    const auto trace = [](std::size_t columns, std::size_t rows) {
        return trace_buffers(PlainWave<double>{}, sun_over_square<double>(), {columns, rows});
    };
    CHECK_THROWS_WITH_AS((void)trace(1, 5),
                         "nephroid::PhotonBuffer: the grid has 1 columns and 5 rows; it needs 2 to 1048576 of each",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)trace(5, 0), std::invalid_argument);
}

TEST_CASE("photon buffer: a square grid has about as many nodes as asked for, of a shape like the light's") {
    EmissionChart<glm::dvec3, double> chart;
    chart.width = 2, chart.height = 0.5;
    const PhotonGrid grid = square_grid(chart, 10000);
    CHECK(grid.columns == 200);
    CHECK(grid.rows == 50);
}

} // namespace nephroid::tests::photon_buffer_test
