// SPDX-License-Identifier: MIT
/// @file  Even light of radiance 1/π from all directions: irradiance 1 wherever nothing is in the way.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/emission/spread.hpp"
#include "nephroid/ray/splat_rays.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include "bounce/closed_rooms.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace nephroid::tests {

/// Emits from a sphere inwards: directions even over all of them, lines even over the disk across each.
template <class T>
struct UniformField {
    using V = glm::vec<3, T>;
    using vector = V;
    using flux_type = T;
    V centre{0, 0, 0};
    double radius = 1;

    [[nodiscard]] double power() const { return 4 * std::numbers::pi * radius * radius; }

    template <class S>
    [[nodiscard]] Photon<V, T, 2> emit(S& samples, const Spread<T>& spread) const {
        const auto next = [&] { return double(samples.template next<double>()); };
        const double z = 2 * next() - 1, r = std::sqrt((std::max)(0.0, 1 - z * z)), phi = 2 * std::numbers::pi * next();
        const V direction = normalize(V(T(r * std::cos(phi)), T(r * std::sin(phi)), T(z)));
        const double disk = std::sqrt(next()), angle = 2 * std::numbers::pi * next(), back = std::sqrt(1 - disk * disk);
        const auto frame = frame_about(direction);
        const V position = centre + T(radius * disk * std::cos(angle)) * frame.u +
                           T(radius * disk * std::sin(angle)) * frame.v - T(radius * back) * direction;
        const V none(0, 0, 0);
        return {position, direction, T(power()) / spread.photons, {Tangent<V>{none, none}, Tangent<V>{none, none}}};
    }
};

/// Vertices at one place of a scene, moved along a line so that their noise averages out.
template <class T>
[[nodiscard]] std::vector<RoomVertex<T>> row(const glm::vec<3, T>& from, const glm::vec<3, T>& to,
                                             const glm::vec<3, T>& normal, int count = 64) {
    std::vector<RoomVertex<T>> all;
    for (int i = 0; i < count; ++i)
        all.push_back({from + (T(i) + T(0.5)) / T(count) * (to - from), normal});
    return all;
}

/// The mean irradiance of vertices.
template <class S, class L, class T, class Policies>
[[nodiscard]] double mean_irradiance(const S& scene, const L& lamp, const std::vector<RoomVertex<T>>& vertices,
                                     std::uint64_t count, const Policies& policies, std::uint64_t seed = 1) {
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<T>(map);
    splat_rays(scene, lamp, sums, {.count = count}, policies, RandomSequence(seed));
    double sum = 0;
    sums.for_each([&](std::size_t, T e) { sum += double(e); });
    return sum / double(vertices.size());
}

} // namespace nephroid::tests
