// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/relaxation/detect_features.hpp"

#include "relaxation/cloud.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::detect_features_test {

using namespace nephroid::detail;

namespace {

/// Of the photons for which `which` holds: the mean weight, and the share that is held along `line` to within 15
/// degrees.
struct Held {
    double count = 0, weight = 0, along = 0;
};

template <class P, class Which>
Held held(const std::vector<P>& photons, const Which& which, const Space& line = {0, 1, 0},
          const RelaxationOptions& options = {}) {
    const auto constraints = detect_features(photons, access_to<P>(), options, SerialExecutor{});
    Held result;
    for (std::size_t i = 0; i < photons.size(); ++i)
        if (which(photons[i].position)) {
            ++result.count;
            result.weight += double(constraints[i].weight);
            result.along += std::abs(static_cast<double>(widen(constraints[i].direction).dot(line))) > 0.966;
        }
    result.weight /= result.count;
    result.along /= result.count;
    return result;
}

} // namespace

// 20,000 photons, 18,200 of them left of x = 0.5: one to 1/190 of the side there, 1/60 beyond.
TEST_CASE("features: photons at an edge of density are held along it and others are free") {
    const auto photons = stepped_floor(20000, 61);
    const Held edge =
        held(photons, [](const auto& p) { return p.x > 0.496 && p.x < 0.5 && std::abs(p.y - 0.5) < 0.4; });
    CHECK(edge.count > 50);
    CHECK(edge.weight > 0.97);
    CHECK(edge.along > 0.9);
    const Held dense = held(photons, [](const auto& p) { return p.x > 0.1 && p.x < 0.4 && std::abs(p.y - 0.5) < 0.4; });
    CHECK(dense.weight < 0.03);
    const Held sparse =
        held(photons, [](const auto& p) { return p.x > 0.65 && p.x < 0.85 && std::abs(p.y - 0.5) < 0.3; });
    CHECK(sparse.weight < 0.03);
}

TEST_CASE("features: the border of what is lit is one") {
    const auto photons = random_floor(10000, 62);
    const Held border = held(photons, [](const auto& p) { return p.x < 0.005 && std::abs(p.y - 0.5) < 0.4; });
    CHECK(border.count > 30);
    CHECK(border.weight > 0.97);
    CHECK(border.along > 0.9);
    // In the corners no direction is left.
    const auto constraints = detect_features(photons, access_to<Stored>(), {}, SerialExecutor{});
    int pinned = 0, corner = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const auto& p = photons[i].position;
        if (std::min(p.x, 1 - p.x) < 0.007 && std::min(p.y, 1 - p.y) < 0.007) {
            ++corner;
            pinned += constraints[i].weight > 0.9 && length(constraints[i].direction) == 0;
        }
    }
    CHECK(pinned * 2 > corner);
}

TEST_CASE("features: the paper's criterion finds edges too and holds more than it should") {
    const auto photons = stepped_floor(10000, 63);
    const RelaxationOptions options{.criterion = FeatureCriterion::gap_variation};
    const auto at_edge = [](const auto& p) { return p.x > 0.495 && p.x < 0.5 && std::abs(p.y - 0.5) < 0.4; };
    const auto inside = [](const auto& p) { return p.x > 0.1 && p.x < 0.4 && std::abs(p.y - 0.5) < 0.4; };
    CHECK(held(photons, at_edge, {0, 1, 0}, options).weight > 0.9);
    CHECK(held(photons, inside, {0, 1, 0}, options).weight > 0.1);
}

TEST_CASE("features: directions are unit vectors in the tangent plane of any surface") {
    // A half-plane of photons turned into space.
    Draws draw(64);
    const Space n = draw.direction(), u = draw.direction().across(n).unit(), v = n.cross(u);
    std::vector<Stored> photons;
    for (int i = 0; i < 3000; ++i) {
        const double x = draw.in(0, 1);
        const Space place = Wide(x) * u + Wide(draw.in(0, 1)) * v + Space{10, -20, 30};
        photons.push_back({i, narrow<glm::dvec3>(place), narrow<glm::dvec3>(n), 1});
    }
    const auto constraints = detect_features(photons, access_to<Stored>(), {}, SerialExecutor{});
    int constrained = 0;
    for (const auto& constraint : constraints) {
        CHECK((constraint.weight >= 0 && constraint.weight <= 1));
        const double size = length(constraint.direction);
        CHECK((size == 0 || std::abs(size - 1) < 1e-12));
        CHECK(std::abs(static_cast<double>(widen(constraint.direction).dot(n))) < 1e-12);
        constrained += constraint.weight > 0;
    }
    CHECK(constrained > 100); // the border, 4 · √3000 photons
    CHECK(constrained < 900);
}

TEST_CASE("features: edges of intensity and of colour are found where density has none") {
    using Rgb = glm::vec3;
    using Coloured = StoredPhoton<glm::vec3, Rgb>;
    const auto lit = [](const Rgb& left, const Rgb& right) {
        Draws draw(65);
        std::vector<Coloured> photons;
        for (int i = 0; i < 8000; ++i) {
            const float x = float(draw.in(0, 1)), y = float(draw.in(0, 1));
            photons.push_back({i, {x, y, 0}, {0, 0, 1}, x < 0.5f ? left : right});
        }
        return photons;
    };
    const auto at_edge = [](const glm::vec3& p) {
        return std::abs(p.x - 0.5f) < 0.005f && std::abs(p.y - 0.5f) < 0.4f;
    };
    const auto inside = [](const glm::vec3& p) { return std::abs(p.x - 0.25f) < 0.1f && std::abs(p.y - 0.5f) < 0.35f; };
    // A thousand photons with the edge amid them: one group of five that is taken for a feature is not to decide.
    const auto about_edge = [](const glm::vec3& p) {
        return std::abs(p.x - 0.5f) < 0.08f && std::abs(p.y - 0.5f) < 0.4f;
    };
    for (const auto& [left, right] :
         {std::pair{Rgb(1), Rgb(10)}, {Rgb(1, 0, 0), Rgb(0, 1, 0)}, {Rgb(1, 0, 0), Rgb(1)}}) {
        const Held edge = held(lit(left, right), at_edge);
        CHECK(edge.weight > 0.95);
        CHECK(edge.along > 0.85);
        CHECK(held(lit(left, right), inside).weight < 0.05);
        CHECK(held(lit(left, right), about_edge, {0, 1, 0}, RelaxationOptions{.flux_features = false}).weight < 0.05);
    }
}

// Each photon carries one of three bands: the map is grey, and no photon's flux is the mean.
TEST_CASE("features: spectral photons of mixed bands are no feature") {
    using Coloured = StoredPhoton<glm::vec3, glm::vec3>;
    Draws draw(66);
    std::vector<Coloured> photons;
    for (int i = 0; i < 8000; ++i) {
        const float x = float(draw.in(0, 1)), y = float(draw.in(0, 1));
        const int band = int(draw.in(0, 3));
        photons.push_back({i, {x, y, 0}, {0, 0, 1}, {band == 0, band == 1, band == 2}});
    }
    CHECK(held(photons, [](const auto& p) {
              return std::abs(p.x - 0.5f) < 0.4f && std::abs(p.y - 0.5f) < 0.4f;
          }).weight < 0.03);
}

// Two sheets of one density, of which one ends at x = 0.5: on the other nothing is to be seen there.
TEST_CASE("features: of another surface in the same place are not mistaken for one's own") {
    auto photons = random_floor(6000, 67);
    for (std::size_t i = 0; i < photons.size(); i += 3) {
        photons[i].position.x *= 0.5;
        photons[i].normal = {0, 0, -1};
    }
    const auto at_edge = [](const auto& p) { return std::abs(p.x - 0.5) < 0.02 && std::abs(p.y - 0.5) < 0.4; };
    std::vector<Stored> upper, lower;
    for (const Stored& photon : photons)
        (photon.normal.z > 0 ? upper : lower).push_back(photon);
    const auto constraints = detect_features(photons, access_to<Stored>(), {}, SerialExecutor{});
    double up = 0, up_weight = 0, down = 0, down_weight = 0;
    for (std::size_t i = 0; i < photons.size(); ++i)
        if (at_edge(photons[i].position)) {
            (photons[i].normal.z > 0 ? up : down) += 1;
            (photons[i].normal.z > 0 ? up_weight : down_weight) += constraints[i].weight;
        }
    CHECK(up_weight / up < 0.1);
    CHECK(down_weight / down > 0.9);
}

TEST_CASE("features: are the same bit for bit for any number of threads") {
    const auto photons = stepped_floor(10000, 68);
    const auto serial = detect_features(photons, access_to<Stored>(), {}, SerialExecutor{});
    for (const unsigned count : {2u, 5u}) {
        ThreadExecutor threads(count);
        const auto parallel = detect_features(photons, access_to<Stored>(), {}, threads);
        REQUIRE(parallel.size() == serial.size());
        CHECK(std::memcmp(parallel.data(), serial.data(), serial.size() * sizeof serial[0]) == 0);
    }
}

TEST_CASE("features: few photons and photons in one place have none") {
    CHECK(detect_features(std::vector<Stored>{}, access_to<Stored>(), {}, SerialExecutor{}).empty());
    const std::vector<Stored> together(300, floor_photon(1, 2));
    for (const auto& constraint : detect_features(together, access_to<Stored>(), {}, SerialExecutor{}))
        CHECK(constraint.weight == 0);
    for (const auto& constraint : detect_features(random_floor(10, 69), access_to<Stored>(), {}, SerialExecutor{}))
        CHECK(constraint.weight == 0);
}

} // namespace nephroid::tests::detect_features_test
