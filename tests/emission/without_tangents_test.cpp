// SPDX-License-Identifier: MIT
#include "nephroid/emission/without_tangents.hpp"

#include "nephroid/emission/light/point.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::without_tangents_test {

namespace {
using Lamp = PointLight<glm::vec3, float>;
static_assert(PhotonSource<Lamp> && PhotonSource<WithoutTangents<Lamp>>);
static_assert(!Light<WithoutTangents<Lamp>> && !PhotonSource<int>);
} // namespace

TEST_CASE("without tangents: photons are the light's own but for the differentials") {
    const Lamp lamp({.position = {1, 2, 3}, .intensity = 5.0f});
    const WithoutTangents bare(lamp);
    CHECK(bare.power() == lamp.power());
    const HaltonSequence sequence;
    const Spread<float> spread{100, 8};
    for (std::uint64_t i = 0; i < 100; ++i) {
        Sampler<HaltonSequence> one(sequence, i), other(sequence, i);
        const auto whole = lamp.emit(one, spread);
        const auto photon = bare.emit(other, spread);
        static_assert(decltype(photon)::tangent_count == 0);
        CHECK(photon.position == whole.position);
        CHECK(photon.direction == whole.direction);
        CHECK(photon.flux == whole.flux);
        CHECK(one.dimension() == other.dimension());
    }
}

} // namespace nephroid::tests::without_tangents_test
