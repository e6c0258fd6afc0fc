// SPDX-License-Identifier: MIT
// What the headers' docstrings show for each point where a renderer brings its own, put together: it compiles.
#include "messages/renderer.hpp"

#include <cmath>

using Vec3 = V;
using Colour = float;

struct MyLaser { // emission/light.hpp
    using vector = Vec3;
    using flux_type = Colour;
    static constexpr nephroid::EmissionDomain domain{.coordinates = 2, .kinks = {nephroid::Kinks::diagonals}};
    Vec3 position, direction;
    float radius;
    Colour flux;

    template <class Samples>
    nephroid::Photon<Vec3, Colour> emit(Samples& samples, const nephroid::Spread<float>& spread) const {
        const float u1 = samples.template next<float>(), u2 = samples.template next<float>();
        const auto disk = nephroid::concentric_disk(u1, u2);
        const nephroid::Frame<Vec3> frame = nephroid::frame_about(direction);
        const float length = spread.length(nephroid::pi<float> * radius * radius); // the domain is the beam's section
        const Vec3 zero(0, 0, 0);
        return {position + radius * disk.x * frame.u + radius * disk.y * frame.v,
                direction,
                flux * (1 / spread.photons),
                {nephroid::Tangent<Vec3>{length * frame.u, zero}, nephroid::Tangent<Vec3>{length * frame.v, zero}}};
    }
    double power() const { return nephroid::flux_traits<Colour>::power(flux); }
};

struct MySequence { // sequence/sequence.hpp
    static constexpr bool stratified = true;
    template <std::floating_point T>
    T sample(std::uint64_t index, std::uint32_t dimension) const {
        return T(index % 16) / T(16 + dimension);
    }
};

struct Bumps { // differential/curvature.hpp
    float a, k, x;
    Vec3 operator()(const Vec3& d_position) const { return Vec3(a * k * k * std::sin(k * x) * d_position.x, 0, 0); }
};

struct MyHit { // transport/hit.hpp
    float distance;
    Vec3 geometric_normal;
    Bumps curvature;
    float position_error;
};

struct Adapter { // transport/scene.hpp
    std::optional<MyHit> intersect(const Vec3& origin, const Vec3& direction, float t_min, float t_max) const {
        const float t = -origin.z / direction.z;
        if (!(t > t_min && t < t_max))
            return std::nullopt;
        return MyHit{t, Vec3(0, 0, 1), {0.1f, 1, origin.x + t * direction.x}, 1e-6f};
    }
    nephroid::Scattering<Colour, float> scatter(const MyHit&, const Vec3&, auto& random) const {
        if (random.template next<float>() < 0.5f)
            return nephroid::Scattering<Colour, float>::deposit();
        return nephroid::Scattering<Colour, float>::reflect(1);
    }
};

struct Triweight { // footprint/kernel.hpp
    static constexpr double second_moment = 1.0 / 10;
    template <nephroid::Scalar T>
    T operator()(const T& radius2) const {
        const T rest = nephroid::keep_if(radius2 < T(1), T(T(1) - radius2));
        return T(4) / nephroid::pi<T> * rest * rest * rest;
    }
};

struct DiscardNeedles { // footprint/policies.hpp
    template <nephroid::Vector3 V3>
    nephroid::Verdict operator()(nephroid::Ellipse<V3>& ellipse, nephroid::scalar_t<V3>) const {
        return nephroid::axis_ratio(ellipse) < 0.01f ? nephroid::Verdict::discarded : nephroid::Verdict::kept;
    }
};

int main() {
    const auto policies = nephroid::Default{}.with_kernel(Triweight{}).with_excess(DiscardNeedles{});
    auto sums = nephroid::sums<Colour>(map, [](std::size_t, const Vec3& direction) { return -direction.z; });
    const auto executor = [](std::size_t count, auto&& task) { // execution/executor.hpp
        for (std::size_t i = 0; i < count; ++i)
            task(i);
    };
    nephroid::caustics(Adapter{}, MyLaser{Vec3(0, 0, 1), Vec3(0, 0, -1), 1, 1}, sums, {.count = 16}, policies,
                       MySequence{}, executor);
    float film = 0;
    sums.for_each([&](std::size_t, const Colour& irradiance) { film += irradiance; }); // receiver/sink.hpp
    return film >= 0 ? 0 : 1;
}
