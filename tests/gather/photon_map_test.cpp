// SPDX-License-Identifier: MIT
#include "nephroid/gather/photon_map.hpp"

#include "gather/stored_photons.hpp"
#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

#include <deque>

namespace nephroid::tests::photon_map_test {

using tests::complaint_of;
using tests::map_of_stored;
using tests::Stored;

namespace {

/// Every photon is in the map once, with its own normal, direction and flux.
template <class V>
void check_against(const PhotonMap<V, scalar_t<V>>& map, const std::vector<Stored<V>>& photons) {
    std::vector<int> seen(photons.size());
    const auto same = [](const V& a, const V& b) { return tests::wide_of(a) == tests::wide_of(b); };
    for (const TreeLeaf& leaf : map.tree().leaves())
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            const auto& photon = photons.at(map.tree().index(slot));
            ++seen[map.tree().index(slot)];
            CHECK(same(map.normal(slot), photon.normal));
            CHECK(same(map.direction(slot), photon.direction));
            CHECK(map.flux(slot) == photon.flux);
            CHECK(map.faces(slot, photon.normal));
            CHECK(!map.faces(slot, -photon.normal));
        }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

} // namespace

TEST_CASE_TEMPLATE("photon map: holds the user's photons of any vector type", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto photons = tests::mixed_photons<V>(300, 41);
        check_against(map_of_stored(photons), photons);
    });
}

TEST_CASE("photon map: its types are deduced from deposits and from projections") {
    using V = glm::dvec3;
    const auto photons = tests::mixed_photons<V>(100, 42);
    std::vector<Deposit<V, double, 0>> bare;
    std::vector<Deposit<V, double>> whole;
    for (const auto& p : photons) {
        bare.push_back({p.position, p.normal, p.direction, p.flux, {}});
        whole.push_back({p.position, p.normal, p.direction, p.flux, {V{1, 0, 0}, V{0, 1, 0}}});
    }
    const PhotonMap from_bare(bare);
    const PhotonMap from_whole(whole);
    static_assert(std::is_same_v<decltype(from_bare), const PhotonMap<V, double>>);
    check_against(from_bare, photons);
    check_against(from_whole, photons);

    const std::deque<Stored<V>> elsewhere(photons.begin(), photons.end());
    using P = Stored<V>;
    const PhotonMap projected(elsewhere, &P::position, &P::normal, &P::direction, [](const P& p) { return p.flux; });
    static_assert(std::is_same_v<decltype(projected), const PhotonMap<V, double>>);
    check_against(projected, photons);
    CHECK(projected.diagonal() == doctest::Approx(std::sqrt(2.0)).epsilon(0.05));
}

TEST_CASE_TEMPLATE("photon map: without photons is empty and has no diagonal", T, float, double) {
    const auto map = map_of_stored(std::vector<Stored<glm::vec<3, T>>>{});
    CHECK(map.tree().empty());
    CHECK(map.diagonal() == 0);
}

TEST_CASE("photon map: says which photon cannot be") {
    using V = glm::vec3;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const V up{0, 0, 1};
    const auto with = [](const Stored<V>& bad) {
        auto photons = tests::random_photons<V>(50, 43);
        photons[17] = bad;
        return complaint_of([&] { return map_of_stored(photons); });
    };
    const auto names = [&](const Stored<V>& bad, const char* what) {
        const std::string complaint = with(bad);
        CAPTURE(complaint);
        CHECK(complaint.starts_with("nephroid::PhotonMap: "));
        CHECK(complaint.find(" 17 ") != std::string::npos);
        CHECK(complaint.find(what) != std::string::npos);
    };
    names({1, {nan, 0, 0}, up, -up}, "finite");
    names({1, {0, infinity, 0}, up, -up}, "finite");
    names({1, {0, 0, 0}, {0, 0, 0}, -up}, "unit length");
    names({1, {0, 0, 0}, {nan, 0, 0}, -up}, "unit length");
    names({1, {0, 0, 0}, up, {0, nan, 0}}, "directions");
    names({nan, {0, 0, 0}, up, -up}, "nan");
    names({infinity, {0, 0, 0}, up, -up}, "inf");
    CHECK(with({1, {0, 0, 0}, up, -up}) == "none");
}

} // namespace nephroid::tests::photon_map_test
