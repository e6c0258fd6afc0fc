// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/emission_cells.hpp"

#include "smoothing/second_order/maps.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace nephroid::tests::emission_cells_test {

using namespace nephroid::detail;
using tests::Draws;
using tests::halton;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

} // namespace

TEST_CASE("emission cells: each photon is in the cell of its sample and in no other") {
    const auto samples = halton(1000);
    for (const double aspect : {0.01, 0.3, 1.0, 4.0, 1000.0}) {
        const EmissionCells cells(samples, aspect, false);
        CAPTURE(aspect);
        CHECK(cells.size() == cells.columns() * cells.rows());
        std::set<std::uint32_t> seen;
        for (std::size_t cell = 0; cell < cells.size(); ++cell)
            for (const std::uint32_t i : cells.photons(cell)) {
                CHECK(cells.cell_of(samples[i]) == cell);
                const auto middle = cells.middle(cell);
                CHECK(std::abs(samples[i][0] - middle[0]) * double(cells.columns()) <= 0.5 + 1e-9);
                CHECK(std::abs(samples[i][1] - middle[1]) * double(cells.rows()) <= 0.5 + 1e-9);
                seen.insert(i);
            }
        CHECK(seen.size() == samples.size());
        const double per_cell = double(samples.size()) / double(cells.size());
        CHECK(per_cell >= 8); // rounding to whole rows and columns
        CHECK(per_cell <= 32);
    }
}

TEST_CASE("emission cells: columns are to rows as the domain's length is to its width") {
    const auto samples = halton(16 * 400);
    const EmissionCells square_domain(samples, 1, false), wide(samples, 4, false), high(samples, 0.25, false);
    CHECK(square_domain.columns() == 20);
    CHECK(square_domain.rows() == 20);
    CHECK(wide.columns() == 40);
    CHECK(wide.rows() == 10);
    CHECK(high.columns() == 10);
    CHECK(high.rows() == 40);
    CHECK(EmissionCells(samples, 1e9, false).rows() == 1);
}

TEST_CASE("emission cells: few photons or none make one cell") {
    for (const std::size_t count : {0u, 1u, 16u, 23u}) {
        const auto samples = halton(count);
        const EmissionCells cells(samples, 1, false);
        REQUIRE(cells.size() == 1);
        CHECK(cells.photons(0).size() == count);
    }
}

TEST_CASE("emission cells: a sample at the domain's end is in the last cell") {
    const auto samples = halton(16 * 400);
    const EmissionCells cells(samples, 1, false);
    const double last = std::nextafter(1.0, 0.0);
    CHECK(cells.cell_of({0, 0}) == 0);
    CHECK(cells.cell_of({last, last}) == cells.size() - 1);
    CHECK(cells.cell_of({1, 1}) == cells.size() - 1); // what a float may round to
}

TEST_CASE("emission cells: cells at the border have no neighbours beyond it unless the domain repeats") {
    const auto samples = halton(16 * 12);
    const EmissionCells open(samples, 4.0 / 3, false), repeats(samples, 4.0 / 3, true);
    REQUIRE(open.columns() == 4);
    REQUIRE(open.rows() == 3);
    CHECK(open.neighbour(5, 1, 0) == 6);
    CHECK(open.neighbour(5, -1, 1) == 8);
    CHECK(open.neighbour(5, 0, -1) == 1);
    CHECK(open.neighbour(5, 0, 0) == 5);
    CHECK(!open.neighbour(0, -1, 0));
    CHECK(!open.neighbour(3, 1, 0));
    CHECK(!open.neighbour(3, 1, 1));
    CHECK(!open.neighbour(8, 0, 1));
    CHECK(repeats.neighbour(0, -1, 0) == 3);
    CHECK(repeats.neighbour(0, -1, -1) == 11);
    CHECK(repeats.neighbour(11, 1, 1) == 0);
    CHECK(!open.repeats());
    CHECK(repeats.repeats());

    const Plane2 across = repeats.step_between({0.9, 0.1}, {0.1, 0.8}),
                 along = open.step_between({0.9, 0.1}, {0.1, 0.8});
    CHECK(across.x == doctest::Approx(0.2));
    CHECK(across.y == doctest::Approx(-0.3));
    CHECK(along.x == doctest::Approx(-0.8));
    CHECK(along.y == doctest::Approx(0.7));
}

TEST_CASE("step fit: finds the matrix that the displacements were made with") {
    Draws draw(2);
    for (int round = 0; round < 50; ++round) {
        const PlaneMatrix m{{draw.in(0.5, 2), draw.in(-0.4, 0.4)}, {draw.in(-0.4, 0.4), draw.in(0.5, 2)}};
        StepFit fit;
        for (int i = 0; i < 5; ++i) {
            const Plane2 step{draw.in(-0.1, 0.1), draw.in(-0.1, 0.1)};
            fit.add(step, m(step));
        }
        const auto found = fit.solve();
        REQUIRE(found);
        // Among steps of a condition of 1e3 at most, squared by the normal equations.
        CHECK(std::abs(found->first.x - m.first.x) <= 1e7 * epsilon);
        CHECK(std::abs(found->first.y - m.first.y) <= 1e7 * epsilon);
        CHECK(std::abs(found->second.x - m.second.x) <= 1e7 * epsilon);
        CHECK(std::abs(found->second.y - m.second.y) <= 1e7 * epsilon);
    }
}

TEST_CASE("step fit: refuses steps on a line and displacements of zero") {
    StepFit nothing, line, still, odd;
    CHECK(!nothing.solve());
    for (const double t : {-1.0, 0.5, 1.0, 2.0}) {
        line.add({t, 2 * t}, {t, t});
        still.add({t, t * t}, {0, 0});
        odd.add({t, t * t}, {std::numeric_limits<double>::quiet_NaN(), t});
    }
    CHECK(!line.solve());
    CHECK(!still.solve());
    CHECK(!odd.solve());
}

TEST_CASE("path sample: its tangents are half of the deposit's") {
    const auto photon = tests::photon_at(tests::affine, {0.5, 0.5}, 100);
    const auto tangents = half_tangents(*photon.deposit);
    const double u0 = tests::unit_of(100);
    CHECK(tangents[0].x == doctest::Approx(2 * u0).epsilon(4 * epsilon));
    CHECK(tangents[0].y == doctest::Approx(0.25 * u0).epsilon(4 * epsilon));
    CHECK(tangents[1].y == doctest::Approx(-u0).epsilon(4 * epsilon));
    CHECK(tangents[1].z == 0);
}

} // namespace nephroid::tests::emission_cells_test
