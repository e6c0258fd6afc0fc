// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/surrounded.hpp"

#include "relaxation/cloud.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::surrounded_test {

using namespace nephroid::detail;

namespace {

/// How many of the photons whose distance to the border of the unit square, over the radius of their disc, lies between
/// two bounds are surrounded, and how many there are.
struct Surrounded {
    int surrounded = 0, all = 0;

    Surrounded(const std::vector<Stored>& photons, std::size_t count, double from, double to) {
        const PhotonCloud<glm::dvec3, double> cloud(photons, access_to<Stored>(), 0.5, "test");
        std::vector<Neighbour<double>> nearest;
        SerialExecutor executor;
        for_each_slot(cloud.tree(), executor, [&](std::size_t slot) {
            const glm::dvec3 p = photons[cloud.tree().index(slot)].position;
            nearest_on_surface(cloud, slot, count, nearest);
            double radius2 = 0;
            for (const auto& other : nearest)
                radius2 = std::max(radius2, other.distance2);
            const double border = std::min({p.x, 1 - p.x, p.y, 1 - p.y}) / std::sqrt(radius2);
            if (!(border >= from && border < to))
                return;
            ++all;
            surrounded += detail::surrounded<PhotonCloud<glm::dvec3, double>>(cloud, slot, nearest, radius2);
        });
    }
};

} // namespace

// The ring of 600 photons begins at sqrt(1 − 96/600) = 0.917 radii. A border misses it by at most 33.75 degrees to
// either side of some eighth of it at 0.917 cos(33.75°) = 0.762 radii. An eighth is empty by chance with a probability
// of 16 exp(−12).
TEST_CASE("surrounded: photons away from a border are and those near it are not") {
    const auto photons = random_floor(6000, 130);
    const Surrounded inside(photons, 600, 1.0, 1e9), beside(photons, 600, 0, 0.76);
    CHECK(inside.all > 1000);
    CHECK(inside.surrounded >= inside.all - inside.all / 100);
    CHECK(beside.all > 1000);
    CHECK(beside.surrounded == 0);
}

// The outer half of 76 photons: an eighth of it, 4.75 photons, is empty by chance with 16 exp(−4.75) at most.
TEST_CASE("surrounded: hardly any small disc seems to lie at a border by chance") {
    const auto photons = random_floor(6000, 131);
    const Surrounded inside(photons, 76, 1.0, 1e9);
    CHECK(inside.all > 3000);
    CHECK(inside.surrounded > (1 - 16 * std::exp(-4.75)) * inside.all);
}

} // namespace nephroid::tests::surrounded_test
