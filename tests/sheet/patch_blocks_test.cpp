// SPDX-License-Identifier: MIT
#include "nephroid/sheet/patch_blocks.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace nephroid::tests::patch_blocks_test {

using namespace nephroid::detail;

namespace {

template <class T>
using Vertex = tests::Vertex<glm::vec<3, T>>;

/// Pixels of the unit square at a height, n × n.
template <class T>
[[nodiscard]] std::vector<Vertex<T>> pixels_at(T height, int n) {
    std::vector<Vertex<T>> vertices;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            vertices.push_back({{(T(i) + T(0.5)) / T(n), (T(j) + T(0.5)) / T(n), height}, {0, 0, 1}});
    return vertices;
}

template <class T>
struct Picture {
    using V = glm::vec<3, T>;
    std::vector<Vertex<T>> vertices;
    EyePathMap<V> map{vertices, &Vertex<T>::position, &Vertex<T>::normal};
    SerialExecutor executor{};
    ReceiverPixels<V> pixels{map, executor};
    std::vector<double> irradiance = std::vector<double>(vertices.size());
    std::size_t blocks = 0, triangles = 0;

    explicit Picture(std::vector<Vertex<T>> of) : vertices(std::move(of)) {}

    bool draw(const PatchCorners& corners, T flux, const Tessellation& rule = {}, double height = 0) {
        LitPatch<V, T> patch{};
        const Double3 origin = double3(map.tree().origin());
        patch.corners = corners;
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t j = 0; j < 2; ++j) {
                patch.corners[i][j].position = corners[i][j].position - origin + Double3{0, 0, height};
                patch.normal[i][j] = {0, 0, 1};
                patch.direction[i][j] = {0, 0, -1};
            }
        patch.flux = flux;
        SheetPieces<V, T> pieces;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> visits;
        const bool is_seen =
            PatchBlocks<V, T>(pixels, rule).add(patch, 1, pieces, [&](std::uint32_t leaf, std::uint32_t block) {
                visits.push_back({leaf, block});
            });
        for (const auto& [leaf, number] : visits) {
            const SheetBlock<V, T>& block = pieces.blocks[number];
            add_to_leaf(pieces, block, pixels, leaf, [&](std::uint32_t slot, T e) {
                irradiance[map.tree().index(slot)] += double(block.flux) * double(e);
            });
        }
        blocks = pieces.blocks.size(), triangles = pieces.triangles.size();
        return is_seen;
    }

    [[nodiscard]] double flux() const {
        double sum = 0;
        for (const double e : irradiance)
            sum += e;
        return sum / double(vertices.size()); // of the unit square
    }
};

/// A bilinear patch, its tangents the chords.
[[nodiscard]] PatchCorners quad(const Double3& a, const Double3& b, const Double3& c, const Double3& d) {
    PatchCorners corners;
    const Double3 at[2][2] = {{a, d}, {b, c}};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            corners[i][j] = {at[i][j], at[1][j] - at[0][j], at[i][1] - at[i][0]};
    return corners;
}

} // namespace

TEST_CASE_TEMPLATE("patch: a rectangle lights each pixel by the share that it covers", T, float, double) {
    Picture<T> picture(pixels_at<T>(0, 32));
    const double low = 5.25 / 32, high = 20.5 / 32;
    CHECK(picture.draw(quad({low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}),
                       T((high - low) * (high - low))));
    const auto share = [](int i) { return i < 5 || i > 20 ? 0.0 : i == 5 ? 0.75 : i == 20 ? 0.5 : 1.0; };
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) {
            const double expected = share(i) * share(j), got = picture.irradiance[std::size_t(32 * j + i)];
            // The footprints' sides come from the vertices' distances: 10⁻⁶ of a pixel in float.
            CHECK(std::abs(got - expected) <= (sizeof(T) == 4 ? 5e-5 : 1e-12));
            if (expected == 0)
                CHECK(got == 0);
        }
}

TEST_CASE_TEMPLATE("patch: a fold keeps its flux", T, float, double) {
    Picture<T> picture(pixels_at<T>(0, 64));
    PatchCorners corners = quad({0.2, 0.2, 0}, {0.5, 0.2, 0}, {0.5, 0.7, 0}, {0.2, 0.7, 0});
    for (std::size_t j = 0; j < 2; ++j) { // goes out to the right and back
        corners[0][j].along_u = {1.2, 0.1, 0};
        corners[1][j].along_u = {-1.0, 0.05, 0};
    }
    CHECK(picture.draw(corners, T(0.75)));
    CHECK(picture.flux() == doctest::Approx(0.75).epsilon(sizeof(T) == 4 ? 2e-5 : 1e-12));
}

TEST_CASE("patch: one that has collapsed to a line or a point keeps its flux") {
    Picture<double> picture(pixels_at<double>(0, 16));
    CHECK(picture.draw(quad({0.2, 0.3, 0}, {0.7, 0.6, 0}, {0.7, 0.6, 0}, {0.2, 0.3, 0}), 0.5));
    CHECK(picture.triangles > 0);
    CHECK(picture.flux() == doctest::Approx(0.5));
    CHECK(picture.draw(quad({0.21, 0.3, 0}, {0.21, 0.3, 0}, {0.21, 0.3, 0}, {0.21, 0.3, 0}), 0.25));
    CHECK(picture.flux() == doctest::Approx(0.75));
}

TEST_CASE("patch: many small ones side by side light a plane evenly") {
    Picture<float> picture(pixels_at<float>(0, 16));
    constexpr int n = 37; // about seven to a pixel, their corners off the pixels'
    const auto at = [](int i, int j) { return Double3{double(i) / n, double(j) / n, 0}; };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            picture.draw(quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)), 1.0f / (n * n));
    for (const double e : picture.irradiance)
        CHECK(e == doctest::Approx(1).epsilon(2e-4)); // of the footprints' sides, in float, where nothing lies beyond
}

TEST_CASE("patch: vertices a fifth of a pixel below it or facing away get no light") {
    Picture<float> above(pixels_at<float>(0, 16));
    const PatchCorners whole = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    above.draw(whole, 1, {}, 0.2 / 16);
    CHECK(above.flux() == 0);
    above.draw(whole, 1, {}, 0.01 / 16); // within a fiftieth of a pixel it is the same surface
    CHECK(above.flux() == doctest::Approx(1).epsilon(1e-4));

    auto turned = pixels_at<float>(0, 16);
    for (auto& vertex : turned)
        vertex.normal = -vertex.normal;
    Picture<float> back(turned);
    back.draw(whole, 1);
    CHECK(back.flux() == 0);
}

TEST_CASE("patch: a patch that no vertex sees is reported as unseen") {
    Picture<float> picture(pixels_at<float>(0, 16));
    CHECK_FALSE(picture.draw(quad({2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}), 1));
    CHECK(picture.blocks == 0);
}

} // namespace nephroid::tests::patch_blocks_test
