// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/neighbourhood.hpp"

#include "relaxation/cloud.hpp"
#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::neighbourhood_test {

using namespace nephroid::detail;

namespace {

template <class V>
using FloorCloud = PhotonCloud<V, scalar_t<V>>;

/// Checks the neighbours of all photons against sorted distances, whatever radii are guessed.
template <class P>
void check_against_brute_force(const std::vector<P>& photons, std::size_t count, double guess) {
    using V = decltype(P::position);
    using T = scalar_t<V>;
    const FloorCloud<V> cloud(photons, access_to<P>(), 0.5, "test");
    const std::vector<T> radius(cloud.tree().slots(), T(guess));
    Neighbourhood<FloorCloud<V>> neighbourhood;
    std::size_t visited = 0;
    bool alike = true;
    for (std::uint32_t leaf = 0; leaf < cloud.tree().leaves().size(); ++leaf)
        neighbourhood.for_each(cloud, leaf, count, radius, [&](std::size_t slot, std::span<const Neighbour<T>> found) {
            ++visited;
            const std::size_t photon = cloud.tree().index(slot);
            std::vector<P> same{photons[photon]};
            for (std::size_t i = 0; i < photons.size(); ++i)
                if (i != photon && dot(photons[photon].normal, photons[i].normal) >= T(0.5))
                    same.push_back(photons[i]);
            const auto expected = distances(same, 0);
            alike = alike && found.size() == std::min(count, expected.size());
            for (std::size_t k = 0; alike && k < found.size(); ++k) {
                // Coordinates up to 1 relative to the origin are rounded once more.
                const double tolerance = 8 * double(std::numeric_limits<T>::epsilon());
                alike = std::abs(std::sqrt(double(found[k].distance2)) - expected[k].first) <= tolerance;
                alike = alike && found[k].slot != slot;
            }
        });
    CHECK(visited == photons.size());
    CHECK(alike);
}

} // namespace

TEST_CASE_TEMPLATE("neighbourhood: finds the nearest whatever radius was guessed", T, float, double) {
    for_each_vector<T>([]<class V>() {
        const auto photons = random_floor<V>(300, 41);
        for (const double guess : {0.0, 0.07, 10.0})
            check_against_brute_force(photons, 7, guess);
    });
}

TEST_CASE("neighbourhood: photons of all spacings find their nearest") {
    Draws draw(42);
    std::vector<Stored> photons;
    for (int i = 0; i < 600; ++i) { // denser towards the corner by a thousand times
        const double x = std::pow(draw.in(0, 1), 4);
        photons.push_back(floor_photon(x, std::pow(draw.in(0, 1), 4), i));
    }
    for (const double guess : {0.0, 0.03, 1.0})
        check_against_brute_force(photons, 7, guess);
}

TEST_CASE("neighbourhood: fewer photons than asked for are all found") {
    for (const int count : {1, 2, 7, 8}) {
        check_against_brute_force(random_floor(count, 43), 7, 0.1);
        check_against_brute_force(std::vector<Stored>(std::size_t(count), floor_photon(3, 4)), 7, 0);
    }
}

// Two sides of a wall, a hundredth of the photons' distance thick.
TEST_CASE("neighbourhood: photons on the other side of a thin wall are none") {
    auto photons = random_floor(600, 44);
    for (std::size_t i = 0; i < photons.size(); i += 2) {
        photons[i].normal = {0, 0, -1};
        photons[i].position.z = -0.0004;
    }
    check_against_brute_force(photons, 7, 0.06);
}

// A photon, six of its surface at a distance of 1, and so many of another surface nearer to it.
TEST_CASE("neighbourhood: its own surface is found behind 128 times as many of another and no more") {
    using Cloud = FloorCloud<glm::dvec3>;
    const auto found_behind = [](int others) {
        std::vector<Stored> photons{floor_photon(0, 0)};
        for (int i = 0; i < 6; ++i)
            photons.push_back(floor_photon(std::cos(i), std::sin(i)));
        for (int i = 0; i < others; ++i) {
            photons.push_back(floor_photon(0.001 * std::cos(i), 0.001 * std::sin(i)));
            photons.back().normal = {0, 0, -1};
        }
        const Cloud cloud(photons, access_to<Stored>(), 0.5, "test");
        const std::vector<double> radius(cloud.tree().slots(), 0.0);
        Neighbourhood<Cloud> neighbourhood;
        std::size_t count = 0;
        for (std::uint32_t leaf = 0; leaf < cloud.tree().leaves().size(); ++leaf)
            neighbourhood.for_each(cloud, leaf, 6, radius, [&](std::size_t slot, auto found) {
                if (cloud.tree().index(slot) == 0)
                    count = found.size();
            });
        return count;
    };
    CHECK(found_behind(int(most_candidates) * 6 - 6) == 6); // itself, the others and six are one more than asked for
    CHECK(found_behind(int(most_candidates) * 6 + 1) == 0);
}

TEST_CASE("neighbourhood: many photons in one place cost no more than as many apart") {
    std::vector<Stored> photons(20000, floor_photon(0.5, 0.5));
    using Cloud = FloorCloud<glm::dvec3>;
    const Cloud cloud(photons, access_to<Stored>(), 0.5, "test");
    const std::vector<double> radius(cloud.tree().slots(), 0.0);
    Neighbourhood<Cloud> neighbourhood;
    std::size_t found_seven = 0; // would take 4e8 distances if every photon looked at all
    for (std::uint32_t leaf = 0; leaf < cloud.tree().leaves().size(); ++leaf)
        neighbourhood.for_each(cloud, leaf, 7, radius, [&](std::size_t, std::span<const Neighbour<double>> found) {
            found_seven += found.size() == 7 && found.back().distance2 == 0;
        });
    CHECK(found_seven == photons.size());
}

} // namespace nephroid::tests::neighbourhood_test
