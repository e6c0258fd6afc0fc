// SPDX-License-Identifier: MIT
#include "emission/light/domain_laws.hpp"

#include "emission/light/coloured_sun.hpp"

#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::domain_laws_test {

using tests::check_domain;

namespace {

using D = glm::dvec3;
using Sphere = BoundingSphere<D>;

/// A light of the renderer's own that goes round: a ring of radius 1 that emits outwards, up to 45 degrees off.
struct Beacon {
    using vector = D;
    using flux_type = double;
    static constexpr EmissionDomain domain{.coordinates = 2, .edges = {DomainEdge::repeats, DomainEdge::ends}};

    template <class S>
    [[nodiscard]] Photon<D, double> emit(S& samples, const Spread<double>& spread) const {
        const double angle = 2 * pi<double> * samples.template next<double>(),
                     height = samples.template next<double>() - 0.5;
        const D outwards{std::cos(angle), std::sin(angle), 0};
        const D direction = normalize(D(outwards + 2 * height * D(0, 0, 1)));
        return {outwards, direction, 1 / spread.photons, {}};
    }
    [[nodiscard]] double power() const { return 1; }
};

} // namespace

TEST_CASE("light domains: those of lights with two coordinates are as they declare") {
    check_domain(PointLight<D, double>({.position = {1, 2, 3}, .intensity = 1}));
    check_domain(PointLight<D, double>({.position = {1, 2, 3}, .intensity = 1, .target = Sphere{{0, 0, 0}, 2}}));
    check_domain(PointLight<D, double>({.position = {0, 0, 0.5}, .intensity = 1, .target = Sphere{{0, 0, 0}, 2}}));
    const auto spot = [](double cos_outer) {
        return SpotLight<D, double>(
            {.position = {1, 2, 3}, .axis = {1, 0, -2}, .cos_inner = 0.9, .cos_outer = cos_outer, .intensity = 1});
    };
    check_domain(spot(0.3));
    check_domain(spot(-1)); // all around
    const auto sun = [](const BeamPatch<D>& patch) {
        return DirectionalLight<D, double>({.direction = {1, 1, -2}, .irradiance = 1, .patch = patch});
    };
    check_domain(sun(Sphere{{0, 0, 0}, 1}));
    check_domain(sun(BeamDisk<D>{{0, 0, 0}, 1}));
    check_domain(sun(Parallelogram<D>{{0, 0, 2}, {1, 0, 0}, {0.2, 1, 0}}));
}

TEST_CASE("light domains: those of area lights are as they declare") {
    for (const std::optional<Sphere>& target : {std::optional<Sphere>(), std::optional<Sphere>(Sphere{{1, 0, -5}, 1}),
                                                std::optional<Sphere>(Sphere{{0, 0, -1}, 2.0})}) {
        CAPTURE(target.has_value());
        check_domain(DiskLight<D, double>(
            {.centre = {0, 0, 0}, .normal = {0.5, 0, -1}, .radius = 1, .radiance = 1, .target = target}));
        check_domain(QuadLight<D, double>(
            {.corner = {0, 0, 0}, .edge_u = {0, 1, 0}, .edge_v = {1, 0.3, 0}, .radiance = 1, .target = target}));
        check_domain(SphereLight<D, double>({.centre = {0, 0, 0}, .radius = 1, .radiance = 1, .target = target}));
    }
    check_domain(MeshLight<D, double>({.triangles = {{D(0, 0, 0), D(1, 0, 0), D(0, 1, 0)}}, .radiance = 1}));
}

TEST_CASE("light domains: one that reaches into its target does not claim to be smooth") {
    const QuadLight<D, double> quad({.corner = {0, 0, 0},
                                     .edge_u = {0, 9, 0},
                                     .edge_v = {9, 0, 0},
                                     .radiance = 1,
                                     .target = Sphere{{0, 0, -0.5}, 1}});
    CHECK(domain_of(quad).kinks[0] == Kinks::unknown);
    check_domain(quad);
}

TEST_CASE("light domains: a renderer's own lights are held to what they declare") {
    check_domain(tests::ColouredSun<D>());
    check_domain(Beacon());
}

TEST_CASE("light domains: a light without its tangents has the domain that it has with them") {
    const PointLight<D, double> lamp({.position = {1, 2, 3}, .intensity = 1});
    const WithoutTangents bare(lamp);
    static_assert(coordinates_of<WithoutTangents<PointLight<D, double>>> == 2);
    CHECK(domain_of(bare).kinks[0] == Kinks::diagonals);
    static_assert(detail::emission_domains<WithoutTangents<StandardLights<D, double>>>.four);
}

} // namespace nephroid::tests::domain_laws_test
