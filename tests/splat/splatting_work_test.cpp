// SPDX-License-Identifier: MIT
/// How much work a splat is: kernel evaluations against the number of vertices in footprints.
#include "nephroid/splat/splat_photons.hpp"

#include "support/space.hpp"
#include "support/vertex.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nephroid::tests::splatting_work_test {

using tests::Draws;

namespace {

using Vec = glm::vec3;

using Vertex = tests::Vertex<Vec>;

/// A uniform kernel that counts how often it is asked.
struct CountingKernel {
    static constexpr double second_moment = 0.25;
    static inline std::size_t evaluations = 0;
    template <Scalar T>
    [[nodiscard]] T operator()(const T& radius2) const {
        ++evaluations;
        return keep_if(radius2 < T(1), T(T(1) / pi<T>));
    }
};

constexpr std::size_t side = 200;
constexpr float spacing = 1.0f / side;

std::vector<Vertex> lattice() {
    std::vector<Vertex> vertices;
    for (std::size_t i = 0; i < side * side; ++i)
        vertices.push_back({Vec((float(i % side) + 0.5f) * spacing, (float(i / side) + 0.5f) * spacing, 0)});
    return vertices;
}

/// Disks that lie within the lattice.
std::vector<Deposit<Vec, float>> disks(float radius, int count) {
    Draws draw(5);
    std::vector<Deposit<Vec, float>> deposits;
    for (int i = 0; i < count; ++i) {
        const Vec at(draw.in(radius, 1 - radius), draw.in(radius, 1 - radius), 0);
        deposits.push_back({at, {0, 0, 1}, {0, 0, -1}, 1, {Vec(2 * radius, 0, 0), Vec(0, 2 * radius, 0)}});
    }
    return deposits;
}

const auto policies = Published{}.with_kernel(CountingKernel{}).with_filter(NoPixelFilter{});

/// The vertices in all leaves whose boxes a disk's box meets, slots that repeat one counted.
std::size_t slots_met(const PointTree<Vec>& tree, const Deposit<Vec, float>& deposit, float radius) {
    const Vec c = tree.relative(deposit.position);
    std::size_t slots = 0;
    for (const TreeNode<float>& node : tree.nodes())
        if (node.leaf != no_leaf &&
            node.box.overlaps({{c.x - radius, c.y - radius, -1}, {c.x + radius, c.y + radius, 1}}))
            slots += (tree.leaves()[node.leaf].size + tree.lanes - 1) / tree.lanes * tree.lanes;
    return slots;
}

} // namespace

// A vertex that was counted twice would receive twice the kernel.
TEST_CASE("splatting work: no vertex receives a photon twice") {
    const auto vertices = lattice();
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    for (const float radius : {2.3f * spacing, 9.1f * spacing, 33.7f * spacing}) {
        auto sums = nephroid::sums<float>(map);
        splat(disks(radius, 1), sums, {}, policies);
        const float once = pi<float> * radius * radius;
        std::size_t lit = 0;
        sums.for_each([&](std::size_t, float sum) {
            if (sum == 0)
                return;
            ++lit;
            CHECK(std::abs(sum * once - 1) < 1e-5);
        });
        // As many lattice points lie in a disk as its area holds, but for some of those on its border, less than two
        // for every spacing of it.
        const double expected = std::numbers::pi * square(double(radius) / spacing);
        CHECK(std::abs(double(lit) - expected) < 4 * std::numbers::pi * double(radius) / spacing);
    }
}

// Area times density is what has to be done. Leaves of n <= 64 vertices of a lattice, split across their longest side,
// have sides of 4 to 16 spacings; on the average their number that a disk of radius r meets follows from its box, grown
// by the side of a leaf: so many vertices more than lie in the disk are looked at, and no others.
TEST_CASE("splatting work: the number of kernel evaluations is area times density plus a leaf's margin") {
    const auto vertices = lattice();
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    for (const float radius : {2.0f * spacing, 9.0f * spacing, 36.0f * spacing}) {
        const auto deposits = disks(radius, 200);
        std::size_t most = 0;
        for (const auto& deposit : deposits)
            most += slots_met(map.tree(), deposit, radius);
        auto sums = nephroid::sums<float>(map);
        CountingKernel::evaluations = 0;
        detail::check_kernel(CountingKernel{});
        const std::size_t to_check = CountingKernel::evaluations; // every call that splats does it once
        splat(deposits, sums, {}, policies);
        CountingKernel::evaluations -= 2 * to_check;
        const double count = double(deposits.size()), evaluations = double(CountingKernel::evaluations) / count;
        const double r = double(radius) / spacing, inside = std::numbers::pi * r * r;
        CAPTURE(r);
        CHECK(CountingKernel::evaluations <= most);
        CHECK(evaluations > inside - 4 * std::numbers::pi * r);
        // A leaf of 64 is 8 spacings across if it is square, and those that are not come in either way.
        const double leaf = 10, filled = 64.0 / 50;
        CHECK(evaluations < filled * square(2 * r + leaf));
    }
}

} // namespace nephroid::tests::splatting_work_test
