// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/group_frames.hpp"

#include "smoothing/second_order/maps.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace nephroid::tests::group_frames_test {

using namespace nephroid::detail;

namespace {

constexpr std::size_t side = 63; // photons along it, 3 × 3 in a cell
constexpr double tangent = 0.5;  // of every photon, in both directions: a unit of its frame is half as long

/// A lamp whose photons start at (u + ½ max(|u|, |v|), v), (u, v) the sample from the square's middle: linear in each
/// of the four triangles that the diagonals make, with kinks between them.
PathSample emitted(const std::array<double, 2>& sample) {
    const double u = sample[0] - 0.5, v = sample[1] - 0.5;
    const glm::dvec3 zero(0), place(u + 0.5 * std::max(std::abs(u), std::abs(v)), v, 1);
    const Photon<glm::dvec3, double> photon{
        place, {0, 0, -1}, 1, {Tangent<glm::dvec3>{{tangent, 0, 0}, zero}, {{0, tangent, 0}, zero}}};
    return {.sample = {sample, 0, 2}, .frame = EmissionFrame(photon), .has_landed = true};
}

/// The lamp's derivatives in units of the frame.
PlaneMatrix derivatives(double u, double v) {
    const double unit = 0.5 * tangent;
    return std::abs(u) > std::abs(v) ? PlaneMatrix{{(1 + std::copysign(0.5, u)) / unit, 0}, {0, 1 / unit}}
                                     : PlaneMatrix{{1 / unit, 0}, {std::copysign(0.5, v) / unit, 1 / unit}};
}

// Numbers of order 10 out of sums of up to 81 photons.
void check_same(const PlaneMatrix& found, const PlaneMatrix& expected) {
    for (const auto& [a, b] : {std::pair(found.first, expected.first), std::pair(found.second, expected.second)}) {
        CHECK(a.x == doctest::Approx(b.x).epsilon(1e-12));
        CHECK(a.y == doctest::Approx(b.y).epsilon(1e-12));
    }
}

} // namespace

TEST_CASE("group frames: each side of a kink along a diagonal has its own matrix") {
    const auto samples = tests::lattice(side, side);
    std::vector<PathSample> photons;
    for (const auto& sample : samples)
        photons.push_back(emitted(sample));
    const PathSamples all(photons);
    detail::GroupCells cells(EmissionCells(samples, 1, false, 9));
    int whole = 0, parted = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        detail::choose_frame(cells[i], cells, all);
        REQUIRE(cells[i].has_frame);
        const auto middle = cells.grid().middle(cells[i].square);
        const double u = middle[0] - 0.5, v = middle[1] - 0.5, cell = 1.0 / std::sqrt(double(cells.size()));
        const double from_diagonal = std::abs(std::abs(u) - std::abs(v));
        if (from_diagonal > 1.5 * cell) {
            for (const PlaneMatrix& to_frame : cells[i].to_frame_by_side)
                check_same(to_frame, derivatives(u, v));
            ++whole;
        } else if (from_diagonal < 0.5 * cell && std::min(std::abs(u), std::abs(v)) > 1.6 * cell) {
            check_same(cells[i].to_frame_by_side[0], derivatives(u, 0));
            check_same(cells[i].to_frame_by_side[1], derivatives(0, v));
            ++parted;
        }
    }
    CHECK(whole > 200);
    CHECK(parted == 4 * 9);
}

TEST_CASE("group frames: a sample lies in the triangle of the side that it is nearest to") {
    CHECK(detail::side_of({0.1, 0.4}) == 0);
    CHECK(detail::side_of({0.9, 0.4}) == 0);
    CHECK(detail::side_of({0.4, 0.1}) == 1);
    CHECK(detail::side_of({0.4, 0.9}) == 1);
}

// Photons in one place, or in a line, span nothing.
TEST_CASE("group frames: photons on a line give no frame") {
    std::vector<PathSample> photons;
    tests::Samples samples;
    for (int i = 0; i < 40; ++i)
        samples.push_back({0.5, (i + 0.5) / 40});
    for (const auto& sample : samples)
        photons.push_back(emitted(sample));
    detail::GroupCells cells(EmissionCells(samples, 1, false, 40));
    REQUIRE(cells.size() == 1);
    detail::choose_frame(cells[0], cells, PathSamples(photons));
    CHECK(!cells[0].has_frame);
}

} // namespace nephroid::tests::group_frames_test
