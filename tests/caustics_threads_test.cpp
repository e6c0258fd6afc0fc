// SPDX-License-Identifier: MIT Caustics by several threads and in several passes. Apart from caustics_test.cpp: the
// thread sanitizer's build has only the files with a test of threads.
#include "nephroid/caustics.hpp"

#include "support/untidy_scene.hpp"

#include "nephroid/sequence/halton.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace nephroid::tests::caustics_threads_test {

using tests::ceiling;
using tests::check_balance;
using tests::image_of;
using tests::lamp;
using tests::map_of;
using tests::still_water;
using tests::untidy;

namespace {

/// What the tests of order and threads render: about half of the photons arrive, from several bounces, after roulette.
template <class Policies, class E>
std::pair<std::vector<float>, Statistics> render_untidy(E&& executor, const std::vector<PhotonPass>& passes) {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    Statistics account;
    for (PhotonPass pass : passes) {
        pass.limits.roulette_after = 1;
        account += nephroid::caustics(untidy(), lamp<float>(1.2f), sums, pass, Policies{}, HaltonSequence{7}, executor);
    }
    return {image_of(sums), account};
}

} // namespace

TEST_CASE_TEMPLATE("caustics: any number of threads renders the same picture bit for bit", Policies, Default,
                   Published) {
    const std::vector<PhotonPass> pass{{.count = 6000}};
    const auto [image, account] = render_untidy<Policies>(SerialExecutor{}, pass);
    CHECK(account[Fate::splatted].photons > 500);
    for (const unsigned threads : {1u, 2u, 7u}) {
        const auto [again, same] = render_untidy<Policies>(ThreadExecutor(threads), pass);
        CAPTURE(threads);
        CHECK(again == image);
        CHECK(same.rays == account.rays);
        CHECK(same.bounded_shifts == account.bounded_shifts);
        CHECK(same[Fate::splatted].flux == account[Fate::splatted].flux);
    }
}

TEST_CASE("caustics: a scene's exception reaches the caller from any of the threads") {
    struct Throws : tests::SheetScene<float> {
        std::optional<SurfaceHit<glm::vec3, Flat>> intersect(const glm::vec3& o, const glm::vec3& d, float low,
                                                             float high) const {
            if (o.z < 1.5f && o.x > 0.5f)
                throw std::runtime_error("out of memory");
            return SheetScene<float>::intersect(o, d, low, high);
        }
    };
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    ThreadExecutor executor(3);
    const auto run = [&] {
        (void)nephroid::caustics(Throws{still_water<float>()}, lamp<float>(), sums, {.count = 5000}, HaltonSequence{},
                                 executor);
    };
    CHECK_THROWS_WITH_AS(run(), "out of memory", std::runtime_error);
}

// Photon i is the same in whichever pass it is traced, so a picture may be made in parts that share the total: to first
// order the same picture, as no photon knows of another.
TEST_CASE_TEMPLATE("caustics: two passes over the parts make the picture of one bit for bit", Policies, Published,
                   Default) {
    const auto whole = render_untidy<Policies>(SerialExecutor{}, {{.count = 5000}});
    for (const std::uint64_t cut : {1u, 512u, 1000u, 4999u}) {
        CAPTURE(cut);
        const auto split = render_untidy<Policies>(
            SerialExecutor{}, {{.count = cut, .total = 5000}, {.first = cut, .count = 5000 - cut, .total = 5000}});
        const auto& sum = split.second;
        CHECK(split.first == whole.first);
        CHECK(sum.rays == whole.second.rays);
        CHECK(sum.emitted.photons == whole.second.emitted.photons);
        CHECK(sum.emitted.flux == doctest::Approx(whole.second.emitted.flux).epsilon(1e-12));
        check_balance(sum);
    }
}

TEST_CASE("caustics: other photons make another picture") {
    const auto [image, account] = render_untidy<Published>(SerialExecutor{}, {{.count = 2000}});
    const auto [other, _] = render_untidy<Published>(SerialExecutor{}, {{.first = 2000, .count = 2000}});
    CHECK(other != image);
}

} // namespace nephroid::tests::caustics_threads_test
