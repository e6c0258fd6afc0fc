// SPDX-License-Identifier: MIT
#include "nephroid/transport/parametric_scene.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/splat/landed_photon.hpp"
#include "support/glass_ball.hpp"
#include "transport/follow.hpp"
#include "transport/prism.hpp"

#include <doctest/doctest.h>

#include <type_traits>

namespace nephroid::tests::parametric_scene_test {

namespace {

using P = Wavelength<EqualBands<16>>;

template <class T>
constexpr double bar = std::is_same_v<T, double> ? 1e-12 : 1e-5;

/// The ball of `glass_ball.hpp`, of a glass that disperses.
template <class T>
struct DispersiveBall : GlassBall<Vec<T>, T> {
    using Base = GlassBall<Vec<T>, T>;
    struct Answer {
        Event event;
        T weight, eta, d_eta;
    };
    Cauchy glass;

    template <class Sampler>
    Answer scatter(const typename Base::Hit& hit, const Vec<T>& direction, Sampler&, const P& light) const {
        const double n = glass.index(light.wavelength), slope = glass.slope(light.wavelength);
        const bool enters = dot(direction, hit.geometric_normal) < T(0);
        return {hit.surface == 0 ? Event::deposit : Event::refract, T(1), T(enters ? 1 / n : n),
                T(enters ? -slope / (n * n) : slope)};
    }
};

using Wide = std::array<long double, 3>;
long double inner(const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Wide moved(const Wide& a, long double t, const Wide& b) { return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]}; }

/// Where light from `origin` lands behind the ball of radius 1 about (0, 0, 1.5), by Snell's law in long double.
Wide landing(const Wide& origin, const Wide& direction, long double index) {
    Wide at = origin, d = direction;
    for (const bool enters : {true, false}) {
        const Wide from = moved(at, -1, {0, 0, 1.5L});
        const long double b = inner(from, d), root = std::sqrt(b * b - (inner(from, from) - 1));
        at = moved(at, enters ? -b - root : -b + root, d);
        Wide normal = moved(at, -1, {0, 0, 1.5L}); // against the ray
        if (!enters)
            normal = {-normal[0], -normal[1], -normal[2]};
        const long double eta = enters ? 1 / index : index, c = -inner(d, normal);
        const long double out = std::sqrt(1 - eta * eta * (1 - c * c));
        d = {eta * d[0] + (eta * c - out) * normal[0], eta * d[1] + (eta * c - out) * normal[1],
             eta * d[2] + (eta * c - out) * normal[2]};
    }
    return moved(at, -at[2] / d[2], d);
}

/// Keeps the last deposit, light straight from the lamp included.
struct Deposits {
    static constexpr bool wants_direct_light = true;
    std::optional<Deposit<Vec<double>, double, 3>> last;
    void deposit(const Deposit<Vec<double>, double, 3>& deposit, const WalkedPath<>&) { last = deposit; }
};

} // namespace

// Two refractions and a rounding of each input; 1/cos² of the steepest angle out, 8, times some epsilons.
TEST_CASE_TEMPLATE("wavelength tangent: through a prism is the closed form", T, float, double) {
    int paths = 0;
    for (const Cauchy& glass : {Cauchy{1.32, 3000}, Cauchy{1.5, 5000}, Cauchy{}})
        for (const double degrees : {30., 45., 55., 63.189, 70., 75.})
            for (const double inclination : {0., 0.03490658503988659, 0.3})
                for (const double wavelength : {400., 587.6, 700.}) {
                    const ThroughPrism exact{degrees * std::numbers::pi / 180, inclination, glass};
                    if (!(exact.sine_out(wavelength) < 0.93))
                        continue; // totally reflected, or nearly
                    ++paths;
                    Prism<T> prism(glass);
                    prism.add_screen(Vec<T>(exact.direction_out(wavelength)), 4);
                    const Vec<T> in(exact.direction_in());
                    auto photon = of_wavelength<T, T>(wavelength, collimated<T>(Vec<T>{0, -1, 0} - T(0.5) * in, in));
                    Statistics account;
                    Constant sampler;
                    const auto deposit = walk(prism, std::move(photon), sampler, {}, account);
                    REQUIRE(deposit);
                    const Vec<double> d = exact.d_direction_out(wavelength);
                    check_close(Vec<double>(photon.differential[2].d_direction), d, bar<T> * length(d));
                    check_close(Vec<double>(photon.direction), exact.direction_out(wavelength), bar<T>);
                }
    CHECK(paths > 60);
}

// The differences' step of 10⁻⁶ leaves 10⁻¹² of truncation, times some 100 for the ball's third derivatives.
TEST_CASE_TEMPLATE("wavelength tangent: through a ball agrees with differences of long doubles", T, float, double) {
    const DispersiveBall<T> ball{{.tint = 1}, {}};
    for (const double radius : {0.1, 0.4, 0.7})
        for (const double wavelength : {410., 550., 690.}) {
            const Vec<T> from{T(radius), T(0.2), 4}, direction = normalize(Vec<T>{T(0.1), T(-0.2), -1});
            Statistics account;
            Constant sampler;
            const auto deposit =
                walk(ball, of_wavelength<T, T>(wavelength, collimated<T>(from, direction)), sampler, {}, account);
            REQUIRE(deposit);
            const long double step = 1e-6L * static_cast<long double>(wavelength);
            const auto at = [&](long double other) {
                const Wide d{direction.x, direction.y, direction.z};
                const long double norm = std::sqrt(inner(d, d)); // of the rounded direction
                return landing({from.x, from.y, from.z}, {d[0] / norm, d[1] / norm, d[2] / norm},
                               1.73869L + 15989 / (other * other));
            };
            const Wide before = at(wavelength - step), after = at(wavelength + step);
            const Vec<double> expected{double((after[0] - before[0]) / (2 * step)),
                                       double((after[1] - before[1]) / (2 * step)), 0};
            check_close(Vec<double>(deposit->d_position[2]), expected,
                        (sizeof(T) == 8 ? 1e-10 : 2e-4) * length(expected));
        }
}

TEST_CASE("wavelength tangent: the other tangents are those of the same index without dispersion") {
    const DispersiveBall<double> ball{{.tint = 1}, {}};
    const double wavelength = 500;
    const GlassBall<Vec<double>, double> plain{.index = ball.glass.index(wavelength), .tint = 1};
    const auto photon = collimated<double>({0.3, 0.2, 4}, {0.1, -0.2, -1});
    Statistics account;
    Constant sampler;
    const auto dispersed = walk(ball, of_wavelength<double, double>(wavelength, photon), sampler, {}, account);
    const auto usual = walk(plain, photon, sampler, {}, account);
    REQUIRE((dispersed && usual));
    CHECK(dispersed->position == usual->position);
    CHECK(dispersed->d_position[0] == usual->d_position[0]);
    CHECK(dispersed->d_position[1] == usual->d_position[1]);
    CHECK(length(dispersed->d_position[2]) > 1e-5);
}

// cos² = 1 − n² sin² is quadratic in λ⁻², and the bound linear: off by (Δn)²/2n of 0.003 in n, here 10⁻³
// of the way. A scene may leave total reflection to the walk, or say so itself.
TEST_CASE_TEMPLATE("wavelength: a path ends at the wavelength of the critical angle", T, float, double) {
    struct Surface : SheetScene<T> {
        bool says_reflect = false;
        typename Prism<T>::Answer scatter(const SurfaceHit<Vec<T>, Flat>& hit, const Vec<T>& direction, Constant&,
                                          const P& light) const {
            const Cauchy glass;
            const double n = glass.index(light.wavelength), sine2 = 1 - square(double(direction.z));
            const Event event = this->sheets[hit.surface].event;
            const bool is_total = event == Event::refract && n * n * sine2 > 1;
            return {is_total && says_reflect ? Event::reflect : event, T(1), T(n), T(glass.slope(light.wavelength))};
        }
    };
    // From inside of the glass, up to its surface.
    Surface surface{{{{{0, 0, 0}, {0, 0, 1}, Event::refract},
                      {{0, 0, 2}, {0, 0, 1}, Event::deposit},
                      {{0, 0, -2}, {0, 0, -1}, Event::deposit}}}};
    const double critical = 550, sine = 1 / Cauchy{}.index(critical);
    for (const bool says_reflect : {false, true})
        for (const double wavelength : {540., 548., 553., 565.}) {
            surface.says_reflect = says_reflect;
            Statistics account;
            Constant sampler;
            auto photon =
                of_wavelength<T, T>(wavelength, collimated<T>({0, 0, -1}, {T(sine), 0, T(std::sqrt(1 - sine * sine))}));
            const auto deposit = walk(surface, std::move(photon), sampler, {}, account);
            REQUIRE(deposit);
            CHECK((deposit->position.z > 0) == (wavelength > critical)); // red passes, as its index is smaller
            const double found = wavelength > critical ? photon.parameters.shortest : photon.parameters.longest;
            CHECK(std::abs(found - critical) <= 4e-3 * std::abs(wavelength - critical) + 2e4 * epsilon<T>);
            CHECK((wavelength > critical ? photon.parameters.longest > 1e9 : photon.parameters.shortest == 0));
        }
}

TEST_CASE("parametric scene: every function gets the parameters that takes them, and the others work as without") {
    using V = Vec<double>;
    struct Takes {
        using medium = int;
        using Hit = SurfaceHit<V, Flat>;
        double tracer_epsilon = 0;
        std::optional<Hit> intersect(const V& o, const V& d, double t_min, double t_max, const P& light) const {
            const double z = light.wavelength / 1000, t = (z - o.z) / d.z; // a floor as high as the wavelength
            return t > t_min && t < t_max ? std::optional(Hit{t, o + t * d, {0, 0, 1}, {0, 0, 1}, {}, 0})
                                          : std::nullopt;
        }
        Scattering<double, double> scatter(const Hit&, const V&, Constant&, const int&) const {
            return Scattering<double, double>::deposit();
        }
        double transmittance(int, double distance, const P& light) const {
            return std::exp(-distance * light.wavelength);
        }
        int medium_at(const V&) const { return 1; }
    };
    const auto photon = of_wavelength<double, double>(500, collimated<double>({0, 0, 1}, {0, 0, -1}));
    Deposits visitor;
    Statistics account;
    Constant sampler;
    walk(Takes{}, photon, sampler, {}, account, visitor);
    REQUIRE(visitor.last);
    CHECK(visitor.last->position.z == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(visitor.last->flux == doctest::Approx(std::exp(-250)).epsilon(1e-12));
}

TEST_CASE("parametric scene: photons without parameters are as large as ever and see the scene itself") {
    using V = glm::vec3;
    using Sun = DirectionalLight<V, float>;
    static_assert(std::is_same_v<detail::scene_for<SheetScene<float>, Sun>, SheetScene<float>>);
    static_assert(!std::is_same_v<detail::parameters_t<Spectral<DirectionalLight<V, Bands<float, 4>>, EqualBands<4>>>,
                                  NoParameters>);
    static_assert(sizeof(Photon<V, float>) == 3 * sizeof(float) * 2 + sizeof(float) + 4 * sizeof(V));
    static_assert(sizeof(detail::LandedPhoton<Sun>) == sizeof(std::optional<Deposit<V, float>>));
    static_assert(tangent_kinds<3, P>[1] == TangentKind::footprint &&
                  tangent_kinds<3, P>[2] == TangentKind::wavelength);
}

} // namespace nephroid::tests::parametric_scene_test
