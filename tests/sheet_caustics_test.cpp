// SPDX-License-Identifier: MIT
#include "nephroid/sheet_caustics.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/pass/diagnose.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::sheet_caustics_test {

namespace {

using Vec3 = glm::vec3;

struct Hit {
    float distance;
    Vec3 geometric_normal;
    Flat curvature;
    float position_error;
    bool is_glass;
};

/// A cut stone of index 2.4 above a floor, z = 0: a table, a crown of eight facets and a pavilion of eight.
struct Stone {
    static constexpr bool scatters_by_chance = false;
    static constexpr Vec3 middle{0.5f, 0.5f, 0.4f};
    static constexpr std::size_t facets = 17;
    std::array<Vec3, facets> normal;
    std::array<float, facets> distance;

    Stone() {
        normal[0] = {0, 0, 1};
        distance[0] = 0.09f;
        for (std::size_t i = 0; i < 8; ++i) {
            const float turn = (float(i) + 0.5f) * 3.14159265f / 4;
            const auto facet = [&](float slope) {
                return glm::normalize(
                    Vec3(std::cos(turn) * std::sin(slope), std::sin(turn) * std::sin(slope), std::cos(slope)));
            };
            normal[1 + i] = facet(0.6f), distance[1 + i] = 0.13f;
            normal[9 + i] = facet(3.14159265f - 0.711f), distance[9 + i] = 0.15f;
        }
    }

    [[nodiscard]] std::optional<Hit> intersect(const Vec3& o, const Vec3& d, float t_min, float t_max) const {
        std::optional<Hit> hit;
        const float floor = -o.z / d.z;
        if (floor > t_min && floor < t_max)
            hit = Hit{floor, {0, 0, 1}, {}, 1e-6f, false};
        float enter = -std::numeric_limits<float>::infinity(), leave = -enter;
        std::size_t first = 0, last = 0;
        for (std::size_t i = 0; i < facets; ++i) {
            const float to = distance[i] - glm::dot(normal[i], o - middle), speed = glm::dot(normal[i], d);
            if (speed < 0 && to / speed > enter)
                enter = to / speed, first = i;
            if (speed > 0 && to / speed < leave)
                leave = to / speed, last = i;
            if (speed == 0 && to < 0)
                return hit;
        }
        if (!(enter < leave))
            return hit;
        for (const auto& [at, facet] : {std::pair(enter, first), std::pair(leave, last)})
            if (at > t_min && at < t_max && (!hit || at < hit->distance)) {
                hit = Hit{at, normal[facet], {}, 1e-6f, true};
                break;
            }
        return hit;
    }

    template <class Random>
    [[nodiscard]] Scattering<float, float> scatter(const Hit& hit, const Vec3& direction, Random&) const {
        if (!hit.is_glass)
            return Scattering<float, float>::deposit();
        return Scattering<float, float>::refract(1, glm::dot(direction, hit.geometric_normal) < 0 ? 1 / 2.4f : 2.4f);
    }
};

/// The same, but it asks for a number, for nothing.
struct StoneByChance : Stone {
    static constexpr bool scatters_by_chance = true;

    template <class Random>
    [[nodiscard]] Scattering<float, float> scatter(const Hit& hit, const Vec3& direction, Random& random) const {
        (void)random.template next<float>();
        return Stone::scatter(hit, direction, random);
    }
};

/// The sun's photons, and nothing said of how they are made.
struct Plain {
    using vector = Vec3;
    using flux_type = float;
    DirectionalLight<Vec3, float> lamp;
    template <class Samples>
    [[nodiscard]] Photon<Vec3, float> emit(Samples& samples, const Spread<float>& spread) const {
        return lamp.emit(samples, spread);
    }
    [[nodiscard]] double power() const { return lamp.power(); }
};

/// Draws the middle of every domain.
struct Middle {
    template <class T>
    [[nodiscard]] T next() const {
        return T(0.5);
    }
};

constexpr int side = 32; // pixels

using Vertex = tests::Vertex<Vec3>;

[[nodiscard]] std::vector<Vertex> floor_vertices() {
    std::vector<Vertex> vertices;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            vertices.push_back({{(float(i) + 0.5f) / side, (float(j) + 0.5f) / side, 0}, {0, 0, 1}});
    return vertices;
}

[[nodiscard]] DirectionalLight<Vec3, float> sun() {
    return DirectionalLight<Vec3, float>({.direction = glm::normalize(Vec3(0.2f, 0.1f, -1)),
                                          .irradiance = 1,
                                          .patch = Parallelogram<Vec3>{{0.1f, 0.15f, 1}, {0.6f, 0, 0}, {0, 0.6f, 0}}});
}

using Picture = std::vector<double>;

/// Photons counted in pixels: what no kernel has touched.
[[nodiscard]] Picture counted(int grid) {
    const Stone stone;
    Picture picture(side * side);
    const Vec3 direction = sun().direction();
    const double flux = 0.36 * std::abs(double(direction.z)) / (double(grid) * grid) * side * side;
    for (int k = 0; k < grid * grid; ++k) {
        Vec3 o(0.1f + 0.6f * (float(k % grid) + 0.5f) / float(grid),
               0.15f + 0.6f * (float(k / grid) + 0.5f) / float(grid), 1),
            d = direction;
        for (int event = 0; event < 300; ++event) {
            const auto hit = stone.intersect(o, d, event == 0 ? 0 : 1e-5f, 100);
            if (!hit)
                break;
            o = o + hit->distance * d;
            if (!hit->is_glass) {
                const int i = int(std::floor(o.x * side)), j = int(std::floor(o.y * side));
                if (event > 0 && i >= 0 && j >= 0 && i < side && j < side)
                    picture[std::size_t(j * side + i)] += flux;
                break;
            }
            const bool enters = glm::dot(d, hit->geometric_normal) < 0;
            const Vec3 n = enters ? hit->geometric_normal : -hit->geometric_normal;
            const float eta = enters ? 1 / 2.4f : 2.4f, c = -glm::dot(d, n), k2 = 1 - eta * eta * (1 - c * c);
            d = k2 < 0 ? glm::reflect(d, n) : eta * d + (eta * c - std::sqrt(k2)) * n;
            d = glm::normalize(d);
        }
    }
    return picture;
}

[[nodiscard]] double relative_error(const Picture& exact, const Picture& got) {
    double miss = 0, sum = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
        miss += std::abs(got[i] - exact[i]), sum += exact[i];
    return miss / sum;
}

[[nodiscard]] double mean(const Picture& picture) {
    double sum = 0;
    for (const double e : picture)
        sum += e;
    return sum / double(picture.size());
}

template <class Draw>
[[nodiscard]] Picture drawn(const Draw& draw) {
    const std::vector<Vertex> vertices = floor_vertices();
    const EyePathMap<Vec3> map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    draw(sums);
    Picture picture(vertices.size());
    sums.for_each([&](std::size_t vertex, float e) { picture[vertex] = double(e); });
    return picture;
}

} // namespace

TEST_CASE("sheets and splats: a cut stone comes out no worse than by splats alone, and none of its light is lost") {
    const Picture exact = counted(1200);
    SheetsAndSplats result;
    const Picture both = drawn([&](auto& sums) { result = sheet_caustics(Stone(), sun(), sums, {.count = 20'000}); });
    const Picture splats = drawn([&](auto& sums) { (void)caustics(Stone(), sun(), sums, {.count = 20'000}); });
    INFO("means: ", mean(exact), ", of both ", mean(both), ", of splats ", mean(splats));
    CHECK(result.sheets.sheets.handed_over.flux > 0.1 * result.sheets.sheets.seen.flux);
    CHECK(relative_error(exact, both) < relative_error(exact, splats));
    CHECK(std::abs(mean(both) - mean(exact)) < 0.03 * mean(exact));
}

TEST_CASE("sheets and splats: what a scene scatters by chance is splatted, all of it") {
    SheetsAndSplats result;
    const Picture both =
        drawn([&](auto& sums) { result = sheet_caustics(StoneByChance(), sun(), sums, {.count = 4000}); });
    CHECK(result.sheets.sheets.by_chance > 0);
    CHECK(result.sheets.sheets.seen.flux == 0);
    const double emitted = 0.36 * std::abs(double(sun().direction().z));
    CHECK(std::abs(result.splats.emitted.flux - emitted) < 1e-3 * emitted);
    CHECK(mean(both) > 0);
}

TEST_CASE("sheets and splats: a lamp without a chart is splatted") {
    const auto disk = DirectionalLight<Vec3, float>(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = BeamDisk<Vec3>{{0.5f, 0.5f, 1}, 0.3f}});
    SheetsAndSplats result;
    const Picture both =
        drawn([&](auto& sums) { result = sheet_caustics(Stone(), Plain{disk}, sums, {.count = 4000}); });
    const Picture splats = drawn([&](auto& sums) { (void)caustics(Stone(), Plain{disk}, sums, {.count = 4000}); });
    CHECK(result.sheets.without_charts == doctest::Approx(disk.power()));
    CHECK(both == splats);
}

TEST_CASE("sheets and splats: what a pass hands over is the same part of its picture as the pass") {
    for (const double share : {1e-4, 1.0 / 384, 1.0 / 64, 0.3, 1.0})
        for (const PhotonPass& pass : {PhotonPass{.first = 3000, .count = 1000, .total = 100'000},
                                       PhotonPass{.first = 0, .count = 100, .total = 10'000}}) {
            CAPTURE(share);
            const PhotonPass its = detail::pass_for(pass, share, 1);
            CHECK(its.count * pass.total == its.total * pass.count);
            CHECK(its.first * pass.count == its.count * pass.first);
        }
}

TEST_CASE("chart light: rectangles that lie side by side are joined") {
    const std::vector<ChartRectangle> parts =
        merged({{0, 0.25, 0, 0.5}, {0.25, 0.5, 0, 0.5}, {0, 0.25, 0.5, 1}, {0.25, 0.5, 0.5, 1}, {0.75, 1, 0, 0.5}});
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].area() == 0.5);
    CHECK(parts[1].area() == 0.125);
}

TEST_CASE("chart light: it emits the flux of its part, and tangents as a beam's patch has them") {
    const auto charts = sun().charts();
    const ChartLight<Vec3, float> part(charts[0], {0.25, 0.5, 0, 0.5});
    CHECK(std::abs(part.power() - sun().power() / 8) < 1e-5 * sun().power());
    Middle middle;
    const Spread<float> spread{100, 1};
    const Photon<Vec3, float> photon = part.emit(middle, spread);
    CHECK(std::abs(double(photon.flux) * 100 - part.power()) < 1e-5 * part.power());
    CHECK(glm::length(photon.position - Vec3(0.1f + 0.375f * 0.6f, 0.15f + 0.25f * 0.6f, 1)) < 1e-5f);
    // Footprints, ellipses of these axes, add up to the part's area.
    const auto& d = photon.differential;
    const float area = glm::length(glm::cross(Vec3(d[0].d_position), Vec3(d[1].d_position)));
    CHECK(std::abs(double(area) * 3.14159265 / 4 * 100 - 0.36 / 8) < 1e-3 * 0.36 / 8);
    CHECK(glm::length(Vec3(d[0].d_direction)) == 0);
}

TEST_CASE("sheets and splats: a pass that is stopped splats no further lamp") {
    const auto disk = DirectionalLight<Vec3, float>(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = BeamDisk<Vec3>{{0.5f, 0.5f, 1}, 0.3f}});
    const LightSet<DirectionalLight<Vec3, float>, Plain> lamps({sun(), Plain{disk}});
    int asked = 0;
    PhotonPass pass{.count = 20'000};
    pass.progress = [&](std::uint64_t) { return ++asked, false; };
    (void)drawn([&](auto& sums) { (void)sheet_caustics(Stone(), lamps, sums, pass); });
    CHECK(asked == 1);
}

TEST_CASE("light sheets: options out of their range are refused, and an executor that leaves a task out") {
    const auto draw = [](const SheetOptions& options, auto&& executor) {
        (void)drawn([&](auto& sums) { (void)light_sheets(Stone(), sun(), sums, {.count = 1000}, options, executor); });
    };
    SerialExecutor serial;
    SheetOptions options;
    options.lamp_points = 0;
    CHECK_THROWS_WITH_AS(draw(options, serial), "nephroid::light_sheets: lamp_points is 0; it must be at least 1",
                         std::invalid_argument);
    options = {};
    options.refinement.levels = 11;
    CHECK_THROWS_AS(draw(options, serial), std::invalid_argument);
    options = {};
    options.tessellation.bend = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(draw(options, serial), std::invalid_argument);
    const auto leaves_out = [](std::size_t count, const auto& task) {
        for (std::size_t i = 0; i + 1 < count; ++i)
            task(i);
    };
    CHECK_THROWS_AS(draw({}, leaves_out), std::invalid_argument);
}

TEST_CASE("light sheets: their account is diagnosed as that of photons is") {
    SheetStatistics statistics;
    (void)drawn([&](auto& sums) { statistics = light_sheets(Stone(), sun(), sums, {.count = 5000}); });
    for (const std::string& sentence : diagnose(statistics.light))
        CHECK(sentence.find("no photon reached") == std::string::npos);
}

} // namespace nephroid::tests::sheet_caustics_test
