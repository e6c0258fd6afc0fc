// SPDX-License-Identifier: MIT
#include "nephroid/tree/nearest_points.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::nearest_points_test {

using tests::Draws;

namespace {

constexpr std::size_t lanes = 16;

/// Offers the distances in their order, and sorts what is found.
template <class T, class Accept = AcceptAll>
std::vector<Neighbour<T>> nearest(const std::vector<T>& distance2, std::size_t wanted,
                                  T limit2 = std::numeric_limits<T>::infinity(), const Accept& accept = {}) {
    detail::NearestPoints<T> points(wanted, limit2, lanes);
    for (std::size_t first = 0; first < distance2.size(); first += lanes) {
        std::array<T, lanes> some;
        some.fill(T(0)); // nearer than all: what does not count must not be taken
        const std::size_t count = (std::min)(lanes, distance2.size() - first);
        std::copy_n(distance2.begin() + std::ptrdiff_t(first), count, some.begin());
        points.offer(some, count, std::uint32_t(first), accept);
    }
    std::vector<Neighbour<T>> found(wanted);
    found.resize(points.put(found));
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.slot < b.slot;
    });
    return found;
}

/// Whether these are the nearest of those that count, by sorting all: the same distances, each point once and its own.
template <class T, class Accept = AcceptAll>
bool are_nearest(const std::vector<Neighbour<T>>& found, const std::vector<T>& distance2, std::size_t wanted,
                 T limit2 = std::numeric_limits<T>::infinity(), const Accept& accept = {}) {
    std::vector<T> all;
    for (std::size_t i = 0; i < distance2.size(); ++i)
        if (accept(i) && (distance2[i] < limit2 || !std::isfinite(limit2)))
            all.push_back(distance2[i]);
    std::sort(all.begin(), all.end());
    if (found.size() != (std::min)(wanted, all.size()))
        return false;
    std::vector<bool> met(distance2.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::size_t slot = found[i].slot;
        if (found[i].distance2 != all[i] || distance2[slot] != all[i] || met[slot] || !accept(slot))
            return false;
        met[slot] = true;
    }
    return true;
}

} // namespace

TEST_CASE_TEMPLATE("nearest points: are those of a sorted list however the distances are spread", T, float, double) {
    Draws draw(1);
    for (const std::size_t size : {1u, 15u, 16u, 17u, 100u, 1000u})
        for (int kind = 0; kind < 6; ++kind) {
            std::vector<T> distance2;
            for (std::size_t i = 0; i < size; ++i) {
                const double u = draw.in(0, 1);
                distance2.push_back(T(kind == 0   ? u
                                      : kind == 1 ? std::pow(10.0, 60 * u - 30) // no interpolation finds its way here
                                      : kind == 2 ? std::floor(4 * u)           // many are equally far
                                      : kind == 3 ? 1.0
                                      : kind == 4 ? double(size - i) // each is nearer than all before
                                                  : double(i)));
            }
            for (const std::size_t wanted : {1u, 2u, 7u, 50u, 200u}) {
                CAPTURE(size);
                CAPTURE(kind);
                CAPTURE(wanted);
                CHECK(are_nearest(nearest(distance2, wanted), distance2, wanted));
                const T limit2 = distance2[size / 2];
                CHECK(are_nearest(nearest(distance2, wanted, limit2), distance2, wanted, limit2));
                const auto accept = [](std::size_t slot) { return slot % 3 != 1; };
                CHECK(are_nearest(nearest(distance2, wanted, limit2, accept), distance2, wanted, limit2, accept));
            }
        }
}

// The squares of distances across all of a scalar's range are infinite. Such points count where no others are left.
TEST_CASE_TEMPLATE("nearest points: those infinitely far come last", T, float, double) {
    const T infinity = std::numeric_limits<T>::infinity();
    std::vector<T> distance2(100, infinity);
    for (const std::size_t i : {3u, 40u, 99u})
        distance2[i] = T(i);
    for (const std::size_t wanted : {1u, 3u, 20u, 99u, 200u})
        CHECK(are_nearest(nearest(distance2, wanted), distance2, wanted));
    CHECK(are_nearest(nearest(distance2, 20, T(50)), distance2, 20, T(50)));
    CHECK(nearest(distance2, 20, T(50)).size() == 2);
}

TEST_CASE("nearest points: a limit of zero leaves none") {
    CHECK(nearest(std::vector<float>(40, 0.0f), 3, 0.0f).empty());
    CHECK(nearest(std::vector<float>{}, 3).empty());
}

} // namespace nephroid::tests::nearest_points_test
