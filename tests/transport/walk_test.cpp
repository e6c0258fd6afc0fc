// SPDX-License-Identifier: MIT
#include "transport/follow.hpp"

#include "nephroid/sequence/random.hpp"

#include "support/foreign_vectors.hpp"

#include <array>
#include <functional>
#include <utility>

namespace nephroid::tests::walk_test {

using tests::check_balance;
using tests::check_close;
using tests::collimated;
using tests::Constant;
using tests::epsilon;
using tests::follow;
using tests::from_point;
using tests::mirror_above_floor;
using tests::quiet_nan;
using tests::Sheet;
using tests::SheetScene;
using tests::Vec;

// The mirror image of the point (x, y, h) is (x, y, −h): from there the ray flies D = (h + 2) / cos to the ceiling,
// and its tangents are D (dω − d (n·dω) / (n·d)) with dω mirrored in z. Three transfers of numbers below 10: 64
// roundings of them.
TEST_CASE_TEMPLATE("walk: a photon by way of a mirror lands where its image shines", T, float, double) {
    const T h = 1.5;
    const auto photon = from_point<T>({T(0.25), -1, h}, {1, T(0.5), -2}, T(0.75));
    Statistics account;
    const auto deposit = follow(mirror_above_floor<T>(T(0.5)), photon, account);
    REQUIRE(deposit);
    const Vec<T> d{photon.direction.x, photon.direction.y, -photon.direction.z};
    const T flown = (h + 2) / d.z;
    const double tolerance = 64 * epsilon<T> * 10;
    check_close(deposit->position, Vec<T>{photon.position.x + flown * d.x, photon.position.y + flown * d.y, 2},
                tolerance);
    check_close(deposit->direction, d, tolerance);
    check_close(deposit->normal, Vec<T>{0, 0, -1}, 0); // towards the photon, though the ceiling's normal is up
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec<T> before = photon.differential[i].d_direction, mirrored{before.x, before.y, -before.z};
        const T along = mirrored.z / d.z;
        check_close(deposit->d_position[i],
                    Vec<T>{flown * (mirrored.x - along * d.x), flown * (mirrored.y - along * d.y), 0}, tolerance);
    }
    CHECK(deposit->flux == T(0.375));
    CHECK(account[Fate::absorbed].flux == 0.375);
    CHECK(account[Fate::absorbed].photons == 0); // it has lost half, and goes on
    CHECK(account.rays == 2);
    CHECK(account.specular_events == 1);
    CHECK(account.corrected_normals == 0);
    check_balance(account, double(deposit->flux), 1);
}

// A slab of thickness t shifts a ray and leaves its direction: on a floor h below, a point source h above it lights the
// circle of radius r(a) = 2 h tan a + t tan a', sin a' = sin a / n, with dr/da = 2 h / cos² a + t cos a / (n cos³
// a').
TEST_CASE_TEMPLATE("walk: a slab of glass shifts a ray and its tangents are those of Snell's law", T, float, double) {
    const double h = 1, t = 0.5, n = 1.5;
    SheetScene<T> scene{{{{0, 0, T(t)}, {0, 0, 1}, Event::refract, T(0.9), 1, T(n)},
                         {{0, 0, 0}, {0, 0, 1}, Event::refract, T(0.9), T(n), 1},
                         {{0, 0, T(-h)}, {0, 0, 1}, Event::deposit}}};
    for (const double a : {0.0, 0.1, 0.5, 1.0, 1.3}) {
        CAPTURE(a);
        const double c = std::cos(a), s = std::sin(a);
        const Vec<T> d{T(s), 0, T(-c)}, zero{0, 0, 0};
        // By the angle a, and around the axis: for a = 0 that is the other way across.
        const Photon<Vec<T>, T> photon{
            {0, 0, T(t + h)}, d, T(1), {Tangent<Vec<T>>{zero, {T(c), 0, T(s)}}, {zero, {0, 1, 0}}}};
        Statistics account;
        const auto deposit = follow(scene, photon, account);
        REQUIRE(deposit);
        const double s1 = s / n, c1 = std::sqrt(1 - s1 * s1);
        const double r = 2 * h * s / c + t * s1 / c1, dr = 2 * h / (c * c) + t * c / (n * c1 * c1 * c1);
        // A turn by dφ about the axis moves the direction by sin a dφ and the point by r dφ: r / sin a for a unit
        // one.
        const double around = 2 * h / c + t / (n * c1);
        const double tolerance = 256 * epsilon<T> * dr; // which the rounding of d at the steepest angle is amplified by
        check_close(deposit->position, Vec<T>{T(r), 0, T(-h)}, tolerance);
        check_close(deposit->direction, d, tolerance);
        check_close(deposit->d_position[0], Vec<T>{T(dr), 0, 0}, tolerance);
        check_close(deposit->d_position[1], Vec<T>{0, T(around), 0}, tolerance);
        CHECK(std::abs(double(deposit->flux) - 0.81) <= 4 * epsilon<T>);
        CHECK(account.specular_events == 2);
        CHECK(account.rays == 3);
        check_balance(account, double(deposit->flux), 1);
    }
}

// x = h tan a', sin a' = eta sin a: dx/d eta = h sin a / cos³ a'. The third tangent is a wavelength: eta grows by 1.
TEST_CASE_TEMPLATE("walk: a wavelength tangent spreads what a surface disperses", T, float, double) {
    struct Disperses : SheetScene<T> {
        struct Answer {
            Event event;
            T weight, eta;
            std::array<T, 3> d_eta;
        };
        Answer scatter(const SurfaceHit<Vec<T>, Flat>& hit, const Vec<T>& d, Constant& sampler) const {
            const auto plain = SheetScene<T>::scatter(hit, d, sampler);
            return {plain.event, plain.weight, plain.eta, {0, 0, 1}};
        }
    };
    const Disperses scene{
        {{{{0, 0, 0}, {0, 0, 1}, Event::refract, T(1), 1, T(1.5)}, {{0, 0, -2}, {0, 0, 1}, Event::deposit}}}};
    const double a = 0.7, s = std::sin(a) / 1.5, c = std::sqrt(1 - s * s);
    const auto two = collimated<T>({0, 0, 1}, {T(std::sin(a)), 0, T(-std::cos(a))});
    const Vec<T> zero{0, 0, 0};
    const Photon<Vec<T>, T, 3> photon{
        two.position, two.direction, T(1), {two.differential[0], two.differential[1], {zero, zero}}};
    Statistics account;
    const auto deposit = follow(scene, photon, account);
    REQUIRE(deposit);
    check_close(deposit->d_position[2], Vec<T>{T(2 * std::sin(a) / (c * c * c)), 0, 0}, 64 * epsilon<T>);
}

TEST_CASE_TEMPLATE("walk: beyond the critical angle a refraction is a reflection", T, float, double) {
    // From inside of glass, at 60 degrees.
    const SheetScene<T> scene{
        {{{0, 0, 0}, {0, 0, -1}, Event::refract, T(1), 1, T(1.5)}, {{0, 0, 2}, {0, 0, 1}, Event::deposit}}};
    Statistics account;
    const auto deposit = follow(scene, collimated<T>({0, 0, 1}, {T(std::sqrt(3.0)), 0, -1}), account);
    REQUIRE(deposit);
    check_close(deposit->direction, Vec<T>{T(std::sqrt(0.75)), 0, T(0.5)}, 8 * epsilon<T>);
    CHECK(account.corrected_normals == 0);
}

TEST_CASE_TEMPLATE("walk: every way to end is booked with the flux that was left", T, float, double) {
    const T weight = T(0.75);
    const Sheet<T> mirror{{0, 0, 0}, {0, 0, 1}, Event::reflect, weight};
    const auto down = collimated<T>({0, 0, 1}, {T(0.3), 0, -1}, T(2)),
               up = collimated<T>({0, 0, 1}, {T(0.3), 0, 1}, T(2));
    const auto ends = [&](const SheetScene<T>& scene, const Photon<Vec<T>, T>& photon, const WalkLimits& limits,
                          Fate fate, double flux, double absorbed) {
        Statistics account;
        CHECK(!follow(scene, photon, account, limits));
        CHECK(account[fate].photons == 1);
        CHECK(account[fate].flux == flux);
        CHECK(account[Fate::absorbed].flux == absorbed);
        check_balance(account);
    };
    ends({{}}, down, {}, Fate::escaped, 2, 0);
    ends({{mirror}}, down, {}, Fate::escaped, 1.5, 0.5);
    ends({{mirror}}, up, {}, Fate::escaped, 2, 0);
    ends({{{{0, 0, 0}, {0, 0, 1}, Event::absorb}}}, down, {}, Fate::absorbed, 2, 2);
    ends({{mirror, {{0, 0, 3}, {0, 0, -1}, Event::absorb}}}, down, {}, Fate::absorbed, 2, 2);
    ends({{{{0, 0, 0}, {0, 0, 1}, Event::deposit}}}, down, {}, Fate::direct, 2, 0);
    ends({{mirror}}, down, {.specular_events = 0}, Fate::terminated, 2, 0);
    // Parallel to what it hits: its footprint has no end. The scene says so, though a plane would not be hit.
    struct Grazing : SheetScene<T> {
        std::optional<SurfaceHit<Vec<T>, Flat>> intersect(const Vec<T>& o, const Vec<T>& d, T, T) const {
            const Vec<T> n = frame_about(d).u;
            return SurfaceHit<Vec<T>, Flat>{T(1), o + d, n, n, {}, 0};
        }
    };
    Statistics account;
    const Photon<Vec<T>, T> along_z = collimated<T>({0, 0, 0}, {0, 0, 1});
    CHECK(!follow(Grazing{{{mirror}}}, along_z, account));
    CHECK(account[Fate::invalid].photons == 1);
    check_balance(account);
}

TEST_CASE_TEMPLATE("walk: between two mirrors a photon is terminated after the events that are allowed", T, float,
                   double) {
    const SheetScene<T> scene{{{{0, 0, 0}, {0, 0, 1}, Event::reflect}, {{0, 0, 1}, {0, 0, 1}, Event::reflect}}};
    for (const unsigned most : {1u, 2u, 64u}) {
        Statistics account;
        CHECK(!follow(scene, collimated<T>({0, 0, T(0.5)}, {T(0.1), 0, 1}), account, {.specular_events = most}));
        CHECK(account[Fate::terminated].photons == 1);
        CHECK(account[Fate::terminated].flux == 1);
        CHECK(account.specular_events == most);
        CHECK(account.rays == most + 1); // the last one finds the mirror that it may not use
        check_balance(account);
    }
    // A diffuse surface may be reached by as many.
    const SheetScene<T> once = mirror_above_floor<T>();
    Statistics account;
    CHECK(follow(once, collimated<T>({0, 0, 1}, {0, 0, -1}), account, {.specular_events = 1}));
}

TEST_CASE_TEMPLATE("walk: a photon without flux ends where it starts and one of nonsense is not summed", T, float,
                   double) {
    const auto scene = mirror_above_floor<T>();
    const T infinity = std::numeric_limits<T>::infinity();
    Statistics account;
    CHECK(!follow(scene, collimated<T>({0, 0, 1}, {0, 0, -1}, T(0)), account));
    CHECK(account[Fate::absorbed].photons == 1);
    std::uint64_t invalid = 0;
    for (const T flux : {quiet_nan<T>, T(-1), infinity, -infinity}) {
        CHECK(!follow(scene, collimated<T>({0, 0, 1}, {0, 0, -1}, flux), account));
        CHECK(account[Fate::invalid].photons == ++invalid);
    }
    CHECK(account.emitted.photons == 5);
    CHECK(account.emitted.flux == 0);
    CHECK(account.rays == 0);
    check_balance(account);
}

TEST_CASE_TEMPLATE("walk: a position or direction that is not finite is traced no further", T, float, double) {
    const auto scene = mirror_above_floor<T>();
    auto lost = collimated<T>({0, 0, 1}, {0, 0, -1}), aimless = lost;
    lost.position.y = quiet_nan<T>;
    aimless.direction.x = std::numeric_limits<T>::infinity();
    Statistics account;
    CHECK(!follow(scene, lost, account));
    CHECK(!follow(scene, aimless, account));
    CHECK(account[Fate::invalid].photons == 2);
    CHECK(account[Fate::invalid].flux == 2);
    CHECK(account.rays == 0);
    check_balance(account);
}

namespace {

/// A scene that answers with nonsense at one place. What it changes the hit or the answer to is up to the test.
template <class T>
struct Broken : SheetScene<T> {
    using Hit = SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>;
    struct medium {};
    std::function<void(Hit&)> spoil_hit = [](Hit&) {};
    std::function<void(Scattering<T, T>&)> spoil_scattering = [](Scattering<T, T>&) {};
    T passes = 1;

    std::optional<Hit> intersect(const Vec<T>& o, const Vec<T>& d, T t_min, T t_max) const {
        const auto found = SheetScene<T>::intersect(o, d, t_min, t_max);
        if (!found)
            return std::nullopt;
        const Vec<T> zero{0, 0, 0};
        Hit hit{found->distance,    found->position,       found->geometric_normal, found->shading_normal,
                {zero, zero, zero}, found->position_error, found->surface};
        spoil_hit(hit);
        return hit;
    }
    template <class Sampler>
    Scattering<T, T> scatter(const Hit& hit, const Vec<T>&, Sampler&) const {
        const auto& sheet = this->sheets[hit.surface];
        Scattering<T, T> answer{sheet.event, sheet.weight, T(1)};
        spoil_scattering(answer);
        return answer;
    }
    T transmittance(medium, T) const { return passes; }
};

} // namespace

TEST_CASE_TEMPLATE("walk: what a scene answers with nonsense never gets into a sum", T, float, double) {
    using Hit = typename Broken<T>::Hit;
    const T infinity = std::numeric_limits<T>::infinity();
    for (const T bad : {quiet_nan<T>, infinity, -infinity}) {
        CAPTURE(double(bad));
        const auto check = [&](const Broken<T>& scene) {
            Statistics account;
            const auto deposit =
                follow(scene, from_point<T>({0, 0, 1}, {T(0.3), T(0.2), -1}, T(2)), account, {.roulette_after = 1});
            check_balance(account, deposit ? double(deposit->flux) : 0, deposit ? 1 : 0);
            return deposit;
        };
        const auto ends_invalid = [&](const Broken<T>& scene) {
            Statistics account;
            CHECK(!follow(scene, from_point<T>({0, 0, 1}, {T(0.3), T(0.2), -1}, T(2)), account, {.roulette_after = 1}));
            CHECK(account[Fate::invalid].photons == 1);
            check_balance(account);
        };
        Broken<T> scene{mirror_above_floor<T>(T(0.75))};
        CHECK(check(scene).has_value());

        INFO("a weight");
        scene.spoil_scattering = [&](auto& answer) { answer.weight = bad; };
        ends_invalid(scene);
        scene = {mirror_above_floor<T>()};
        INFO("a transmittance");
        scene.passes = bad;
        ends_invalid(scene);
        scene = {mirror_above_floor<T>()};
        INFO("a geometric normal");
        scene.spoil_hit = [&](Hit& hit) { hit.geometric_normal = {bad, bad, bad}; };
        ends_invalid(scene);
        scene.spoil_hit = [&](Hit& hit) { hit.geometric_normal.z = bad; };
        check(scene);
        INFO("a position");
        scene.spoil_hit = [&](Hit& hit) { hit.position.x = bad; };
        ends_invalid(scene);
        INFO("a distance");
        scene.spoil_hit = [&](Hit& hit) { hit.distance = bad; };
        check(scene);
        INFO("a bound on the error");
        scene.spoil_hit = [&](Hit& hit) { hit.position_error = bad; };
        ends_invalid(scene);
        INFO("a shading normal");
        scene.spoil_hit = [&](Hit& hit) { hit.shading_normal = {bad, bad, bad}; };
        check(scene);
        INFO("a curvature");
        scene.spoil_hit = [&](Hit& hit) { hit.curvature.column_x = {bad, bad, bad}; };
        check(scene);
        scene = {mirror_above_floor<T>()};
        INFO("an index of refraction");
        scene.spoil_scattering = [&](auto& answer) {
            if (answer.event == Event::reflect)
                answer = {Event::refract, T(1), bad};
        };
        check(scene);
    }
}

TEST_CASE_TEMPLATE("walk: a medium absorbs along the way that a photon flies through it", T, float, double) {
    struct Glass : SheetScene<T> {
        struct medium {
            T extinction = 0; // air, where light starts
        };
        struct Answer {
            Event event;
            T weight, eta;
            struct medium medium;
        };
        Answer scatter(const SurfaceHit<Vec<T>, Flat>& hit, const Vec<T>& d, Constant& sampler) const {
            const auto plain = SheetScene<T>::scatter(hit, d, sampler);
            return {plain.event, plain.weight, plain.eta, {dot(d, hit.geometric_normal) < T(0) ? T(0.7) : T(0)}};
        }
        T transmittance(const medium& m, T distance) const { return std::exp(-m.extinction * distance); }
    };
    const double s = 0.5, s1 = s / 1.5, c1 = std::sqrt(1 - s1 * s1);
    const Vec<T> direction{T(s), 0, T(-std::sqrt(1 - s * s))};
    Glass scene{{{{{0, 0, 2}, {0, 0, 1}, Event::refract, T(1), 1, T(1.5)},
                  {{0, 0, 0}, {0, 0, -1}, Event::refract, T(1), 1, T(1.5)},
                  {{0, 0, -1}, {0, 0, 1}, Event::deposit}}}};
    SUBCASE("through a slab") {
        Statistics account;
        const auto deposit = follow(scene, collimated<T>({0, 0, 3}, direction, T(2)), account);
        REQUIRE(deposit);
        const double expected = 2 * std::exp(-0.7 * 2 / c1);
        // The way is short by the ray's distance from the surface it left: 2 · 8 roundings of 2 + 2 + 1.
        CHECK(std::abs(double(deposit->flux) - expected) <= (16 + 0.7 * 80) * epsilon<T>);
        check_balance(account, double(deposit->flux), 1);
    }
    SUBCASE("and goes on doing so after a reflection inside") {
        scene.sheets[1].event = Event::reflect;
        scene.sheets[2] = {{0, 0, 3}, {0, 0, 1}, Event::deposit};
        Statistics account;
        const auto deposit = follow(scene, collimated<T>({0, 0, T(2.5)}, direction), account);
        REQUIRE(deposit);
        CHECK(std::abs(double(deposit->flux) - std::exp(-0.7 * 4 / c1)) <= (16 + 0.7 * 160) * epsilon<T>);
        check_balance(account, double(deposit->flux), 1);
    }
    SUBCASE("nor does a total reflection leave the medium") {
        // Out of the lower side at more than the critical angle: it stays inside although the answer was to refract.
        scene.sheets[0] = {{0, 0, 2}, {0, 0, 1}, Event::refract, T(1), T(1.5), T(1.5)};
        scene.sheets[2] = {{0, 0, 3}, {0, 0, 1}, Event::deposit};
        const double s2 = 0.8, c2 = 0.6;
        Statistics account;
        const auto deposit = follow(scene, collimated<T>({0, 0, T(2.5)}, {T(s2), 0, T(-c2)}), account);
        REQUIRE(deposit);
        CHECK(std::abs(double(deposit->flux) - std::exp(-0.7 * 4 / c2)) <= (16 + 0.7 * 160) * epsilon<T>);
    }
}

// Twelve mirrors of reflectance 0.8: 0.8^12 = 0.0687 arrives on average. From the fourth on a photon's flux is 1 or
// nothing, so the mean is that of 20000 throws: its standard deviation is 0.0018, 5 of them one failure in 1.7 million.
TEST_CASE_TEMPLATE("walk: Russian roulette keeps the mean flux and the account of every photon", T, float, double) {
    // A shaft between two mirrors; the photon goes zigzag and is let out by the floor.
    const SheetScene<T> shaft{{{{0, 0, 0}, {1, 0, 0}, Event::reflect, T(0.8)},
                               {{1, 0, 0}, {-1, 0, 0}, Event::reflect, T(0.8)},
                               {{0, 0, T(-12)}, {0, 0, 1}, Event::deposit}}};
    const RandomSequence sequence(99);
    Statistics account;
    double deposited = 0;
    std::uint64_t deposits = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        Sampler<RandomSequence> sampler(sequence, std::uint64_t(i));
        // 12 units down, 12 across: from the middle it crosses 0.5, then 1 each.
        const auto deposit =
            walk(shaft, collimated<T>({T(0.5), 0, 0}, {1, 0, -1}), sampler, {.roulette_after = 4}, account);
        if (deposit) {
            CHECK(std::abs(double(deposit->flux) - 1) <= 32 * epsilon<T>);
            deposited += double(deposit->flux);
            ++deposits;
        }
    }
    const double expected = std::pow(0.8, 12);
    CHECK(std::abs(deposited / count - expected) <= 5 * std::sqrt(expected / count));
    check_balance(account, deposited, deposits);
    CHECK(account[Fate::terminated].photons == count - deposits);
    // What the mirrors took, 1 − 0.8^4 before the roulette and a fifth of all that came later; the roulette itself is
    // a fair game: nothing on average, with a deviation of less than 8 throws of a photon each.
    CHECK(std::abs(account[Fate::terminated].flux / count) <= 5 * std::sqrt(8.0 / count));
}

TEST_CASE_TEMPLATE("walk: Russian roulette is not played with photons that lost nothing", T, float, double) {
    const SheetScene<T> mirrors{{{{0, 0, 0}, {0, 0, 1}, Event::reflect}, {{0, 0, 1}, {0, 0, 1}, Event::reflect}}};
    Constant sampler{0.999};
    Statistics account;
    CHECK(!walk(mirrors, collimated<T>({0, 0, T(0.5)}, {0, 0, 1}), sampler,
                {.specular_events = 20, .roulette_after = 1}, account));
    CHECK(sampler.drawn == 0);
    CHECK(account.specular_events == 20);
}

// The first number of most sequences is zero, which is below any probability: 1 over that overflows.
TEST_CASE_TEMPLATE("walk: Russian roulette with next to nothing left makes no infinity", T, float, double) {
    for (const T weight : {std::numeric_limits<T>::denorm_min(), (std::numeric_limits<T>::min)(), T(0)}) {
        Statistics account;
        const auto deposit = follow(mirror_above_floor<T>(weight), collimated<T>({0, 0, 1}, {0, 0, -1}), account,
                                    {.roulette_after = 1}, 0);
        check_balance(account, deposit ? double(deposit->flux) : 0, deposit ? 1 : 0);
    }
}

TEST_CASE("walk: the survivor of Russian roulette carries its colour") {
    const SheetScene<float, glm::vec3> scene{
        {{{0, 0, 0}, {0, 0, 1}, Event::reflect, {0.5f, 0.25f, 0}}, {{0, 0, 2}, {0, 0, 1}, Event::deposit}}};
    const auto photon = collimated<float, glm::vec3>({0, 0, 1}, {0, 0, -1}, {2, 2, 2});
    for (const double draw : {0.2499, 0.2501}) {
        Statistics account;
        const auto deposit = follow(scene, photon, account, {.roulette_after = 1}, draw);
        CHECK(deposit.has_value() == (draw < 0.25)); // a quarter of its power, the bands' mean, is left
        if (deposit)
            check_close(deposit->flux, glm::vec3{4, 2, 0}, 1e-6);
        check_balance(account, deposit ? flux_traits<glm::vec3>::power(deposit->flux) : 0, deposit ? 1 : 0);
    }
}

TEST_CASE_TEMPLATE("walk: takes any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        struct Mirror {
            std::optional<SurfaceHit<V, Flat>> intersect(const V& o, const V& d, T, T) const {
                using t = vector_traits<V>;
                const T floor = t::z(d) < 0 ? T(0) : T(2), distance = (floor - t::z(o)) / t::z(d);
                const V p = make_vector<V>(t::x(o) + distance * t::x(d), t::y(o) + distance * t::y(d), floor);
                const V n = make_vector<V>(0, 0, 1);
                return SurfaceHit<V, Flat>{
                    distance, p, n, n, {}, rounding_error(o, distance, p), floor > T(1) ? 1u : 0u};
            }
            Scattering<T, T> scatter(const SurfaceHit<V, Flat>& hit, const V&, Constant&) const {
                return {hit.surface == 0 ? Event::reflect : Event::deposit, 1, 1};
            }
        };
        const V d = make_vector<V>(T(0.6), 0, T(-0.8)), zero = zero_vector<V>();
        const auto [u, v] = frame_about(d);
        const Photon<V, T> photon{make_vector<V>(0, 1, 1), d, T(1), {Tangent<V>{u, zero}, Tangent<V>{v, zero}}};
        Statistics account;
        const auto deposit = follow(Mirror{}, photon, account);
        REQUIRE(deposit.has_value());
        using t = vector_traits<V>;
        // The ray left the mirror at 2 · 8 roundings of 1 + 0.75 + 1.25 above it: it starts 48, and some, too early.
        CHECK(std::abs(double(t::x(deposit->position)) - 3 * 0.75) <= 64 * epsilon<T>);
        CHECK(std::abs(double(t::y(deposit->position)) - 1) <= 32 * epsilon<T>);
    });
}

// A mirror below and a ceiling, whose answers know no refraction.
template <class Answer>
struct RoomWithoutGlass {
    Event event = Event::reflect;

    std::optional<SurfaceHit<glm::dvec3, Flat>> intersect(const glm::dvec3& o, const glm::dvec3& d, double,
                                                          double) const {
        const double floor = d.z < 0 ? 0 : 2, distance = (floor - o.z) / d.z;
        const glm::dvec3 p = o + distance * d, n{0, 0, 1};
        return SurfaceHit<glm::dvec3, Flat>{distance, p, n, n, {}, rounding_error(o, distance, p), floor > 1 ? 1u : 0u};
    }
    Answer scatter(const SurfaceHit<glm::dvec3, Flat>& hit, const glm::dvec3&, Constant&) const {
        Answer answer;
        answer.event = hit.surface == 0 ? event : Event::deposit;
        answer.weight = 1;
        return answer;
    }
};

TEST_CASE("walk: a scene of mirrors needs no index of refraction") {
    Statistics with, without;
    const auto photon = collimated<double>({0, 0, 1}, {0.5, 0, -1});
    const auto expected = follow(RoomWithoutGlass<Scattering<double, double>>{}, photon, with);
    const auto deposit = follow(RoomWithoutGlass<MirrorScattering<double>>{}, photon, without);
    REQUIRE((expected && deposit));
    CHECK(deposit->position == expected->position);
    CHECK(deposit->d_position[0] == expected->d_position[0]);
    CHECK(deposit->d_position[1] == expected->d_position[1]);
    // Refracting all the same is a mistake, and is counted as one.
    CHECK(!follow(RoomWithoutGlass<MirrorScattering<double>>{Event::refract}, photon, without));
    CHECK(without[Fate::invalid].photons == 1);
}

TEST_CASE("walk: a photon that is kept stays as it was, and goes where one that is given away goes") {
    const auto photon = from_point<double>({0.25, -1, 1.5}, {1, 0.5, -2}, 0.75);
    auto given_away = photon;
    Constant sampler{0.5};
    Statistics account;
    const auto scene = mirror_above_floor<double>(0.5);
    const auto kept = walk(scene, photon, sampler, WalkLimits{}, account);
    const auto given = walk(scene, std::move(given_away), sampler, WalkLimits{}, account);
    const auto again = walk(scene, photon, sampler, WalkLimits{}, account);
    REQUIRE((kept && given && again));
    for (const auto& other : {*given, *again}) {
        CHECK(other.position == kept->position);
        CHECK(other.direction == kept->direction);
        CHECK(other.flux == kept->flux);
        CHECK(other.d_position == kept->d_position);
    }
}

} // namespace nephroid::tests::walk_test
