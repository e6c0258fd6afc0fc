// SPDX-License-Identifier: MIT
#include "nephroid/ray/splat_rays.hpp"

#include "common/builtin_cases.hpp"
#include "nephroid/quality/reference/wave.hpp"
#include "nephroid/splat/splat_caustics.hpp"

#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::tests::beams_test {

// On a plane a beam is the photon differential's splat, but for how its width changes within the kernel. That is of
// second order in the beam's growth, (s u0/t)² = (8/√(20,000 π))² = 0.001 times the light's own change.
TEST_CASE("beams: on the floor under a wave they are as good as the splats of the same photons") {
    using T = double;
    using V = examples::Vec3<T>;
    const auto wave = examples::builtin_case<T, T>("wave-prefocal", false);
    REQUIRE(wave.has_value());
    constexpr int n = 32;
    std::vector<Vertex<V>> vertices;
    for (int i = 0; i < n * n; ++i)
        vertices.push_back({V(0.3 + 0.4 * (i % n + 0.5) / n, 0.3 + 0.4 * (i / n + 0.5) / n, 0)});
    const EyePathMap map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    const auto exact = reference::wave({.amplitude = 0.012, .fresnel = false}, {0.3, 0.7, 0.3, 0.7, n, n});
    const PhotonPass pass{.count = 20'000, .smoothing = 8};
    auto splats = nephroid::sums<T>(map), beams = nephroid::sums<T>(map);
    splat_caustics(wave->scene, wave->light, splats, pass);
    splat_rays(wave->scene, wave->light, beams, pass, Rays{}.with_flights(CausticFlights{}));
    const auto error = [&](const auto& sums) {
        double squares = 0;
        sums.for_each([&](std::size_t vertex, double e) { squares += square(e - exact[vertex]); });
        return std::sqrt(squares / (n * n));
    };
    std::vector<double> picture(vertices.size());
    splats.for_each([&](std::size_t vertex, double e) { picture[vertex] = e; });
    double apart = 0;
    beams.for_each([&](std::size_t vertex, double e) { apart += square(e - picture[vertex]); });
    CHECK(std::sqrt(apart / (n * n)) < 0.001);
    CHECK(std::abs(error(beams) - error(splats)) < 0.001);
    CHECK(error(beams) < 0.05); // 0.028
}

} // namespace nephroid::tests::beams_test
