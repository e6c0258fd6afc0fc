// SPDX-License-Identifier: MIT
#include "nephroid/gather/diffusion.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/gather/fixed_range.hpp"

#include "gather/stored_photons.hpp"
#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::diffusion_test {

using tests::complaint_of;
using tests::Draws;
using tests::map_of_stored;
using tests::Stored;

namespace {

/// Light at random on x + y < 1, none beyond.
template <class V>
std::vector<Stored<V>> up_to_the_diagonal(std::size_t count, std::uint32_t seed) {
    auto photons = tests::random_photons<V>(count, seed);
    std::erase_if(photons,
                  [](const Stored<V>& p) { return tests::wide_of(p.position).x + tests::wide_of(p.position).y > 1; });
    return photons;
}

/// A symmetric 2 x 2 matrix on the floor.
struct Tensor {
    double xx = 0, xy = 0, yy = 0;
};

/// The photons about a photon on the floor: the k nearest that face the same way, and the distance of the k-th.
struct Neighbourhood {
    std::vector<std::pair<std::size_t, glm::dvec3>> members;
    double radius = 0;
};
template <class V>
Neighbourhood around(const std::vector<Stored<V>>& photons, std::size_t of, std::size_t k) {
    Neighbourhood n;
    for (std::size_t i = 0; i < photons.size(); ++i)
        if (tests::times(tests::wide_of(photons[i].normal), tests::wide_of(photons[of].normal)) > 0)
            n.members.push_back({i, tests::wide_of(photons[i].position) - tests::wide_of(photons[of].position)});
    std::sort(n.members.begin(), n.members.end(), [](const auto& a, const auto& b) {
        return tests::times(a.second, a.second) < tests::times(b.second, b.second);
    });
    n.members.resize((std::min)(k, n.members.size()));
    n.radius = std::sqrt(tests::times(n.members.back().second, n.members.back().second));
    return n;
}

/// Each photon's matrix D⁻¹, of eigenvalues 1 along and (along/α) across, by the formulas of the docstring.
template <class V>
std::vector<Tensor> inverse_diffusion(const std::vector<Stored<V>>& photons, const DiffusionOptions& options) {
    std::vector<glm::dvec3> gradient(photons.size());
    for (std::size_t p = 0; p < photons.size(); ++p) {
        const auto n = around(photons, p, options.gradient_count);
        glm::dvec3 slope(0);
        double level = 0;
        for (const auto& [i, d] : n.members) {
            const double u2 = tests::times(d, d) / (n.radius * n.radius), flux = double(photons[i].flux);
            slope += flux * (1 - u2) * d / n.radius;
            level += flux * (1 - u2) * (1 - u2);
        }
        gradient[p] = 4.0 / level * slope;
    }
    std::vector<Tensor> inverse;
    for (std::size_t p = 0; p < photons.size(); ++p) {
        const auto n = around(photons, p, options.gradient_count);
        Tensor s;
        double total = 0;
        for (const auto& [i, d] : n.members) {
            const double w = square(1 - tests::times(d, d) / (n.radius * n.radius));
            s.xx += w * gradient[i].x * gradient[i].x;
            s.xy += w * gradient[i].x * gradient[i].y;
            s.yy += w * gradient[i].y * gradient[i].y;
            total += w;
        }
        // The larger eigenvalue's vector by its defining equation (S − μ) e = 0.
        const double mean = 0.5 * (s.xx + s.yy) / total,
                     root = std::sqrt(mean * mean - (s.xx * s.yy - s.xy * s.xy) / (total * total));
        glm::dvec3 e(s.xy / total, mean + root - s.xx / total, 0);
        e /= std::sqrt(tests::times(e, e));
        const double a = options.least_ratio;
        const double along = a + (1 - a) * std::exp(-options.diffusivity / square(2 * root));
        const double extra = along / a - 1;
        inverse.push_back({1 + extra * e.x * e.x, extra * e.x * e.y, 1 + extra * e.y * e.y});
    }
    return inverse;
}

} // namespace

// In double: the tensors are a chain of sums and an eigenvector, so their rounding is magnified; 1e-9 is 10^6 epsilon.
TEST_CASE("diffusion: the estimate is that of the formulas taken one by one") {
    using V = glm::dvec3;
    auto photons = up_to_the_diagonal<V>(400, 111);
    for (std::size_t i = 0; i < photons.size(); i += 6) // some on the back, of another flux
        photons[i].normal = -photons[i].normal, photons[i].flux *= 2;
    const DiffusionOptions options{.range = 0.2, .gradient_count = 25, .diffusivity = 0.3, .least_ratio = 0.1};
    const auto map = map_of_stored(photons);
    const DiffusionEstimate estimate(map, options);
    const auto inverse = inverse_diffusion(photons, options);
    Draws draw(112);
    for (int query = 0; query < 50; ++query) {
        const V place{draw.in(0, 1), draw.in(0, 1), 0}, normal{0, 0, query % 4 == 0 ? -1 : 1};
        double expected = 0, scale = 1;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const V d = photons[i].position - place;
            const Tensor& m = inverse[i];
            const double r2 = (m.xx * d.x * d.x + 2 * m.xy * d.x * d.y + m.yy * d.y * d.y) / 0.04;
            const double density = std::sqrt(m.xx * m.yy - m.xy * m.xy) / 0.04;
            if (photons[i].normal.z * normal.z > 0 && r2 < 1)
                expected += photons[i].flux * density * 3 / std::numbers::pi * square(1 - r2);
        }
        scale = (std::max)(scale, expected);
        CAPTURE(query);
        CHECK(std::abs(estimate(place, normal) - expected) <= 1e-9 * scale);
    }
}

// Over a lattice of places the sum is the photons' flux: kernels at least 0.25 √0.05 = 0.056 wide, 7 spacings; the
// transform of the biweight, 48 |J₃(ω)|/ω³ at ω = 2π · 7, is 7e-5.
TEST_CASE("diffusion: every photon's light is kept whatever its kernel's shape") {
    using V = glm::dvec3;
    auto photons = up_to_the_diagonal<V>(2000, 113);
    double flux = 0;
    for (const auto& p : photons)
        flux += p.flux;
    const auto map = map_of_stored(photons);
    const DiffusionEstimate estimate(map, {.range = 0.25});
    double sum = 0, narrowest = 1;
    constexpr int n = 192; // over −0.25 … 1.25
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            sum += estimate({1.5 * (i + 0.5) / n - 0.25, 1.5 * (j + 0.5) / n - 0.25, 0}, {0, 0, 1}) * square(1.5 / n);
    for (std::size_t slot = 0; slot < map.tree().leaves()[0].size; ++slot)
        narrowest = (std::min)(narrowest, estimate.axis_ratio(slot));
    CHECK(std::abs(sum / flux - 1) < 2e-4);
    CHECK(narrowest < 0.9);
}

TEST_CASE("diffusion: kernels are nearly disks in even light and lie along edges") {
    using V = glm::dvec3;
    const auto photons = up_to_the_diagonal<V>(20000, 114);
    const auto map = map_of_stored(photons);
    const DiffusionEstimate estimate(map, {.range = 0.03});
    const PointTree<V>& tree = map.tree();
    double inside = 0, at_edge = 0, count_inside = 0, count_at_edge = 0;
    for (const TreeLeaf& leaf : tree.leaves())
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            const V p = photons[tree.index(slot)].position;
            const double to_edge = (1 - p.x - p.y) / std::sqrt(2.0);
            if (p.x > 0.1 && p.y > 0.1 && to_edge > 0.1)
                inside += estimate.axis_ratio(slot), ++count_inside;
            if (p.x > 0.1 && p.y > 0.1 && to_edge < 0.01)
                at_edge += estimate.axis_ratio(slot), ++count_at_edge;
        }
    CHECK(inside / count_inside > 0.85); // noise alone narrows some: 0.9 and more measured
    CHECK(at_edge / count_at_edge < 0.5);

    // So the edge is blurred less than by disks of the same range, and light leaks less far beyond it.
    const FixedRange disks(map, {.range = 0.03});
    const auto mean_at = [](const auto& e, double to_edge) {
        double sum = 0;
        for (int i = 0; i < 100; ++i) {
            const double t = 0.2 + 0.006 * i, off = to_edge / std::sqrt(2.0);
            sum += e({t + off, 1 - t + off, 0}, {0, 0, 1}) / 100;
        }
        return sum;
    };
    CHECK(mean_at(disks, 0.008) > 0.1);
    CHECK(mean_at(estimate, 0.008) < 0.6 * mean_at(disks, 0.008));
    CHECK(std::abs(mean_at(estimate, -0.05) - 1) < 0.1);
}

TEST_CASE("diffusion: kernels that are retuned are those made anew") {
    using V = glm::dvec3;
    const auto map = map_of_stored(up_to_the_diagonal<V>(1000, 118));
    DiffusionEstimate retuned(map, {.range = 0.3, .gradient_count = 40, .diffusivity = 1, .least_ratio = 0.5});
    const DiffusionOptions options{.range = 0.1, .gradient_count = 40, .diffusivity = 0.05, .least_ratio = 0.02};
    retuned.retune(options);
    const DiffusionEstimate anew(map, options);
    double narrowest = 1;
    for (std::size_t slot = 0; slot < map.tree().slots(); ++slot) {
        REQUIRE(retuned.axis_ratio(slot) == anew.axis_ratio(slot));
        narrowest = (std::min)(narrowest, anew.axis_ratio(slot));
    }
    CHECK(narrowest < 0.5);
    for (const double x : {0.1, 0.3, 0.5})
        CHECK(retuned({x, 0.4, 0}, {0, 0, 1}) == anew({x, 0.4, 0}, {0, 0, 1}));
    CHECK(complaint_of([&] { return retuned.retune({.range = 0}), 0; }).find("range is 0") != std::string::npos);
}

TEST_CASE_TEMPLATE("diffusion: takes any vector", T, float, double) {
    const glm::dvec3 reference_place{0.4, 0.3, 0};
    double reference = 0;
    {
        const auto map = map_of_stored(up_to_the_diagonal<glm::dvec3>(400, 115));
        reference = DiffusionEstimate(map, {.range = 0.1})(reference_place, {0, 0, 1});
    }
    tests::for_each_vector<T>([&]<class V>() {
        const auto map = map_of_stored(up_to_the_diagonal<V>(400, 115));
        const DiffusionEstimate<V, T> estimate(map, {.range = 0.1});
        const V place = make_vector<V>(T(reference_place.x), T(reference_place.y), 0);
        CHECK(double(estimate(place, make_vector<V>(0, 0, 1))) == doctest::Approx(reference).epsilon(1e-3));
    });
}

TEST_CASE_TEMPLATE("diffusion: of no photons or one or coincident ones gives disks and no NaN", T, float, double) {
    using V = glm::vec<3, T>;
    const V up{0, 0, 1}, place{T(0.25), T(0.5), 0};
    const auto nothing = map_of_stored(std::vector<Stored<V>>{});
    CHECK(DiffusionEstimate(nothing, {.range = 1})(place, up) == 0);
    for (const std::size_t count : {1u, 100u}) {
        const auto map = map_of_stored(std::vector<Stored<V>>(count, tests::on_floor<V>(0.25, 0.5, 1)));
        const DiffusionEstimate estimate(map, {.range = 0.5});
        CHECK(double(estimate(place, up)) == doctest::Approx(double(count) * 3 / std::numbers::pi / 0.25));
        CHECK(estimate(place, -up) == 0);
        CHECK(estimate({std::numeric_limits<T>::quiet_NaN(), 0, 0}, up) == 0);
    }
}

TEST_CASE("diffusion: several threads make the same kernels bit for bit") {
    using V = glm::vec3;
    const auto map = map_of_stored(up_to_the_diagonal<V>(3000, 116));
    ThreadExecutor executor(4);
    const DiffusionEstimate serial(map, {.range = 0.1}), threaded(map, {.range = 0.1}, BiweightKernel{}, executor);
    for (std::size_t slot = 0; slot < map.tree().slots(); ++slot)
        REQUIRE(serial.axis_ratio(slot) == threaded.axis_ratio(slot));
}

TEST_CASE("diffusion: says which option cannot be") {
    using V = glm::vec3;
    const auto map = map_of_stored(tests::random_photons<V>(10, 117));
    const auto complaint = [&](const DiffusionOptions& options) {
        return complaint_of([&] { return DiffusionEstimate(map, options); });
    };
    CHECK(complaint({.range = 1}) == "none");
    CHECK(complaint({.range = -1}).starts_with("nephroid::DiffusionEstimate: range is -1"));
    CHECK(complaint({.range = 1e-200}).starts_with("nephroid::DiffusionEstimate: range is 1e-200, whose square"));
    CHECK(complaint({.range = 1, .gradient_count = 2}).find("gradient_count is 2") != std::string::npos);
    CHECK(complaint({.range = 1, .gradient_range = 0}).find("gradient_range is 0") != std::string::npos);
    CHECK(complaint({.range = 1, .diffusivity = 0}).find("diffusivity is 0") != std::string::npos);
    CHECK(complaint({.range = 1, .least_ratio = 2}).find("least_ratio is 2") != std::string::npos);
}

} // namespace nephroid::tests::diffusion_test
