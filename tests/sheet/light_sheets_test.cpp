// SPDX-License-Identifier: MIT
#include "nephroid/sheet/light_sheets.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::light_sheets_test {

namespace {

using Vec3 = glm::vec3;

/// A hit that knows neither curvature that matters nor ids.
struct PlainHit {
    float distance;
    Vec3 geometric_normal;
    Flat curvature;
    float position_error;
    bool is_mirror;
};

/// Horizontal rectangles, and one mirror that turns a beam along x down: it lies in x = 2 − z, so that what flies at
/// (y, z) lands at (2 − z, y).
struct Shelves {
    struct Shelf {
        float height, x_min, x_max;
    };
    std::vector<Shelf> shelves;
    float mirror_low = 1, mirror_high = 2; ///< z of the mirror's ends

    [[nodiscard]] std::optional<PlainHit> intersect(const Vec3& o, const Vec3& d, float t_min, float t_max) const {
        std::optional<PlainHit> hit;
        const auto take = [&](float t, const Vec3& normal, bool is_mirror) {
            if (t > t_min && t < t_max && (!hit || t < hit->distance))
                hit = PlainHit{t, normal, {}, 1e-6f, is_mirror};
        };
        const float t = (2 - o.x - o.z) / (d.x + d.z), z = o.z + t * d.z;
        if (z >= mirror_low && z <= mirror_high)
            take(t, glm::normalize(Vec3(-1, 0, -1)), true);
        for (const Shelf& shelf : shelves)
            if (d.z != 0) {
                const float at = (shelf.height - o.z) / d.z, x = o.x + at * d.x;
                if (x >= shelf.x_min && x < shelf.x_max)
                    take(at, {0, 0, 1}, false);
            }
        return hit;
    }

    template <class Random>
    [[nodiscard]] MirrorScattering<float> scatter(const PlainHit& hit, const Vec3&, Random&) const {
        return hit.is_mirror ? MirrorScattering<float>::reflect(1) : MirrorScattering<float>::deposit();
    }
};

/// A pane at z = 1. It passes light straight on to the floor, z = 0, but for the share that it reflects to a ceiling,
/// z = 2. The ceiling ends at x = 0.43, so that the reflected sheet does, and the other one does not.
struct Pane {
    static constexpr float ceiling_end = 0.43f;
    float reflected;

    [[nodiscard]] std::optional<PlainHit> intersect(const Vec3& o, const Vec3& d, float t_min, float t_max) const {
        std::optional<PlainHit> hit;
        for (const float height : {0.0f, 1.0f, 2.0f}) {
            const float t = (height - o.z) / d.z;
            if (t > t_min && t < t_max && (!hit || t < hit->distance) && (height < 2 || o.x < ceiling_end))
                hit = PlainHit{t, {0, 0, 1}, {}, 1e-6f, height == 1};
        }
        return hit;
    }

    template <class Random>
    [[nodiscard]] Scattering<float, float> scatter(const PlainHit&, const Vec3&, Random&) const {
        return Scattering<float, float>::deposit();
    }

    [[nodiscard]] Ways<Scattering<float, float>, 2> scatter_all(const PlainHit& hit, const Vec3&) const {
        Ways<Scattering<float, float>, 2> ways;
        if (!hit.is_mirror) {
            ways.add(Scattering<float, float>::deposit());
        } else {
            ways.add(Scattering<float, float>::refract(1 - reflected, 1));
            ways.add(Scattering<float, float>::reflect(reflected));
        }
        return ways;
    }
};

using Vertex = tests::Vertex<Vec3>;

constexpr int side = 32; // pixels

void add_pixels(std::vector<Vertex>& vertices, float height, float x_min = 0, float x_max = 1) {
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            if (const float x = (float(i) + 0.5f) / side; x > x_min && x < x_max)
                vertices.push_back({{x, (float(j) + 0.5f) / side, height}, {0, 0, 1}});
}

/// Along x, over y and z − 1 in this range; 1 on what it meets.
[[nodiscard]] DirectionalLight<Vec3, float> beam(float low, float high) {
    return DirectionalLight<Vec3, float>(
        {.direction = {1, 0, 0},
         .irradiance = 1,
         .patch = Parallelogram<Vec3>{{-2, low, 1 + low}, {0, high - low, 0}, {0, 0, high - low}}});
}

struct Result {
    SheetStatistics statistics;
    std::vector<float> irradiance; ///< by vertex
};

template <class S = Shelves, class L>
[[nodiscard]] Result draw(const S& scene, const L& light, const std::vector<Vertex>& vertices, std::uint64_t nodes,
                          unsigned threads = 1) {
    const EyePathMap<Vec3> map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    ThreadExecutor executor(threads);
    Result result{light_sheets(scene, light, sums, {.count = nodes}, {}, executor),
                  std::vector<float>(vertices.size())};
    sums.for_each([&](std::size_t vertex, float e) { result.irradiance[vertex] = e; });
    return result;
}

} // namespace

TEST_CASE("light sheets: a beam's border is as sharp as the beam") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0);
    const Result result = draw({{{0, -10, 10}}}, beam(0.25f, 0.75f), vertices, 289);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3& p = vertices[i].position;
        const bool is_lit = std::abs(p.x - 0.5f) < 0.25f && std::abs(p.y - 0.5f) < 0.25f;
        CHECK(std::abs(result.irradiance[i] - float(is_lit)) <= 1e-3f);
    }
    CHECK(result.statistics.sheets.cut_cells == 0);
    CHECK(result.statistics.light.emitted.flux == doctest::Approx(0.25));
    CHECK(result.statistics.sheets.seen.flux == doctest::Approx(0.25));
}

TEST_CASE("light sheets: a table's edge, of hits that have no ids, lights neither the floor below nor the air beside") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0.5f, 0, 0.5f);
    const std::size_t on_table = vertices.size();
    add_pixels(vertices, 0);
    const Result result = draw({{{0.5f, -10, 0.5f}, {0, -10, 10}}}, beam(0, 1), vertices, 1000);
    double table = 0, floor = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3& p = vertices[i].position;
        const bool is_shaded = i >= on_table && p.x < 0.5f;
        if (is_shaded && p.x < 0.5f - 1.0f / side)
            CHECK(result.irradiance[i] == 0);
        (i < on_table ? table : floor) += double(result.irradiance[i]) / (side * side);
        if (!is_shaded && std::abs(p.x - 0.5f) > 1.0f / side)
            CHECK(result.irradiance[i] == doctest::Approx(1).epsilon(1e-3));
    }
    CHECK(result.statistics.sheets.parted > 0);
    CHECK(table == doctest::Approx(0.5).epsilon(0.005));
    CHECK(floor == doctest::Approx(0.5).epsilon(0.005));
}

TEST_CASE("light sheets: a shelf a fifteenth of a pixel below another gets no light through it") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0.002f, 0, 0.5f);
    const std::size_t on_upper = vertices.size();
    add_pixels(vertices, 0);
    // Cells no wider than a pixel: two heights within a tenth of a pixel are one surface to the cell at the edge.
    const Result result = draw({{{0.002f, -10, 0.5f}, {0, -10, 10}}}, beam(0, 1), vertices, 1200);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const float x = vertices[i].position.x;
        if (i >= on_upper && x < 0.5f - 1.0f / side)
            CHECK(result.irradiance[i] == 0);
        else if (std::abs(x - 0.5f) > 1.0f / side)
            CHECK(result.irradiance[i] == doctest::Approx(1).epsilon(1e-3));
    }
}

TEST_CASE("light sheets: the same bits by one, two and seven threads") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0.5f, 0, 0.5f);
    add_pixels(vertices, 0);
    const Shelves scene{{{0.5f, -10, 0.5f}, {0, -10, 10}}};
    const Result one = draw(scene, beam(0, 1), vertices, 5000);
    for (const unsigned threads : {2u, 7u}) {
        const Result several = draw(scene, beam(0, 1), vertices, 5000, threads);
        CHECK(std::memcmp(one.irradiance.data(), several.irradiance.data(), sizeof(float) * vertices.size()) == 0);
        CHECK(one.statistics.sheets.seen.flux == several.statistics.sheets.seen.flux);
        CHECK(one.statistics.sheets.nodes == several.statistics.sheets.nodes);
    }
}

TEST_CASE("light sheets: a receiver that is kept makes the same bits as one that is not, picture after picture") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0);
    const Shelves scene{{{0, -10, 10}}};
    const EyePathMap<Vec3> map(vertices, &Vertex::position, &Vertex::normal);
    const SheetReceiver receiver(map);
    for (const float low : {0.25f, 0.4f}) {
        const auto light = beam(low, 0.75f);
        const Result expected = draw(scene, light, vertices, 289);
        auto sums = nephroid::sums<float>(map);
        const SheetStatistics statistics = light_sheets(scene, light, sums, receiver, {.count = 289});
        CHECK(statistics.sheets.cells == expected.statistics.sheets.cells);
        CHECK(statistics.sheets.seen.flux == expected.statistics.sheets.seen.flux);
        std::vector<float> irradiance(vertices.size());
        sums.for_each([&](std::size_t vertex, float e) { irradiance[vertex] = e; });
        CHECK(std::memcmp(irradiance.data(), expected.irradiance.data(), irradiance.size() * sizeof(float)) == 0);
    }
}

#if defined(__cpp_exceptions)
TEST_CASE("light sheets: a receiver of another map than the sums' is refused") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0);
    const EyePathMap<Vec3> map(vertices, &Vertex::position, &Vertex::normal), other = map;
    const SheetReceiver receiver(other);
    auto sums = nephroid::sums<float>(map);
    const auto light = beam(0.25f, 0.75f);
    CHECK_THROWS_WITH_AS(light_sheets(Shelves{{{0, -10, 10}}}, light, sums, receiver, {.count = 289}),
                         "nephroid::light_sheets: the receiver is of another map than the sums; make it of sums.map()",
                         std::invalid_argument);
}
#endif

TEST_CASE("light sheets: a mirror smaller than its beam loses no light at its ends") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0);
    Shelves scene{{{0, -10, 10}}};
    scene.mirror_low = 1.3f, scene.mirror_high = 1.71f; // between two nodes, and within a pixel
    const Result result = draw(scene, beam(0.1f, 0.9f), vertices, 2000);
    double flux = 0;
    for (const float e : result.irradiance)
        flux += double(e) / (side * side);
    CHECK(flux == doctest::Approx(0.8 * 0.41).epsilon(0.002));
    const Statistics& light = result.statistics.light;
    CHECK(light.emitted.flux == doctest::Approx(0.64));
    CHECK(light.accounted_flux() + result.statistics.unresolved == doctest::Approx(light.emitted.flux).epsilon(1e-6));
    CHECK(std::abs(result.statistics.unresolved) < 0.02); // nodes weigh the borders by whole cells
}

TEST_CASE("light sheets: where a dim sheet ends few photons look for its end, and little light is misplaced") {
    std::vector<Vertex> vertices;
    for (const float height : {0.0f, 2.0f})
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                vertices.push_back(
                    {{(float(i) + 0.5f) / side, (float(j) + 0.5f) / side, height}, {0, 0, height > 1 ? -1.0f : 1.0f}});
    const DirectionalLight<Vec3, float> down(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = Parallelogram<Vec3>{{0, 0, 1.5f}, {1, 0, 0}, {0, 1, 0}}});
    std::uint64_t nodes = 0;
    for (const float reflected : {0.5f, 0.01f}) {
        CAPTURE(reflected);
        const Result result = draw(Pane{reflected}, down, vertices, 1000);
        double above = 0, below = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            (vertices[i].position.z > 1 ? above : below) += double(result.irradiance[i]) / (side * side);
        CHECK(below == doctest::Approx(1 - reflected).epsilon(1e-4));
        // Where a sheet as bright as the other one ends is known to an eighth of a pixel. Of a dim one no more light is
        // misplaced.
        CHECK(std::abs(above - double(reflected * Pane::ceiling_end)) < 0.5 / 8 / side);
        if (nodes > 0)
            CHECK(result.statistics.sheets.nodes + 100 < nodes);
        nodes = result.statistics.sheets.nodes;
    }
}

TEST_CASE("light sheets: what is too broken to be drawn is handed over whole, and none of it is drawn") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0);
    Shelves scene{{{0, -10, 10}}};
    scene.mirror_low = 1.49f, scene.mirror_high = 1.51f; // a strip thinner than a cell, and one grid line in it
    const EyePathMap<Vec3> map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    double area = 0;
    const auto take_over = [&](const EmissionChart<Vec3, float>&, const ChartRectangle& part) {
        area += (part.u_end - part.u_begin) * (part.v_end - part.v_begin);
    };
    const SheetOptions regular{.refinement = {.levels = 0}};
    const SheetStatistics statistics =
        light_sheets(scene, beam(0, 1), sums, {.count = 121}, regular, SerialExecutor{}, take_over);
    CHECK(statistics.sheets.broken_tiles == 1);
    CHECK(area == doctest::Approx(1));
    CHECK(statistics.sheets.handed_over.flux == doctest::Approx(0.02).epsilon(0.1));
    CHECK(statistics.sheets.seen.flux == 0);
    sums.for_each([](std::size_t, float e) { CHECK(e == 0); });
}

TEST_CASE("light sheets: passes that share a picture add up to it") {
    std::vector<Vertex> vertices;
    add_pixels(vertices, 0);
    const EyePathMap<Vec3> map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    const Shelves scene{{{0, -10, 10}}};
    for (std::uint64_t pass = 0; pass < 4; ++pass)
        (void)light_sheets(scene, beam(0.25f, 0.75f), sums, {.first = pass * 300, .count = 300, .total = 1200});
    sums.for_each([&](std::size_t vertex, float e) {
        const Vec3& p = vertices[vertex].position;
        const bool is_lit = std::abs(p.x - 0.5f) < 0.25f && std::abs(p.y - 0.5f) < 0.25f;
        CHECK(std::abs(e - float(is_lit)) <= 1e-3f);
    });
}

} // namespace nephroid::tests::light_sheets_test
