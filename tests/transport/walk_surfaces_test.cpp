// SPDX-License-Identifier: MIT
// How a walk turns about the normals of surfaces, and how its rays leave them.
#include "transport/follow.hpp"

namespace nephroid::tests::walk_surfaces_test {

using tests::check_balance;
using tests::check_close;
using tests::collimated;
using tests::Constant;
using tests::epsilon;
using tests::follow;
using tests::from_point;
using tests::mirror_above_floor;
using tests::SheetScene;
using tests::Vec;

namespace {

/// The mirror z = 0 with a shading normal of the test's choice, below a ceiling z = 2.
template <class T>
struct BentMirror : SheetScene<T> {
    Vec<T> shading{0, 0, 1};
    std::optional<SurfaceHit<Vec<T>, Flat>> intersect(const Vec<T>& o, const Vec<T>& d, T t_min, T t_max) const {
        auto hit = SheetScene<T>::intersect(o, d, t_min, t_max);
        if (hit && hit->surface == 0)
            hit->shading_normal = shading;
        return hit;
    }
};

} // namespace

TEST_CASE_TEMPLATE("walk: reflects about the shading normal where the geometry allows it", T, float, double) {
    BentMirror<T> scene{mirror_above_floor<T>(), normalize(Vec<T>{T(0.2), T(0.1), 1})};
    const Vec<T> d = normalize(Vec<T>{T(0.3), 0, -1});
    for (const T side : {T(1), T(-1)}) { // however the scene turns its normals: the walk turns them to the photon
        scene.sheets[0].normal = {0, 0, side};
        scene.shading = side * scene.shading;
        Statistics account;
        const auto deposit = follow(scene, collimated<T>({0, 0, 1}, d), account);
        REQUIRE(deposit);
        check_close(deposit->direction, Vec<T>(d - (2 * dot(d, scene.shading)) * scene.shading), 8 * epsilon<T>);
        CHECK(account.corrected_normals == 0);
    }
}

TEST_CASE_TEMPLATE("walk: a shading normal that sends light through a mirror is corrected and counted", T, float,
                   double) {
    // At a low angle the tilted normal throws the photon down (second), or does not even face it (third and fourth).
    const Vec<T> d = normalize(Vec<T>{1, 0, T(-0.2)});
    for (const Vec<T>& shading :
         {Vec<T>{T(-0.8), 0, T(0.6)}, normalize(Vec<T>{T(0.15), 0, 1}), {T(0.8), 0, T(0.6)}, {T(0.28), 0, T(0.96)}}) {
        const BentMirror<T> scene{mirror_above_floor<T>(), shading};
        Statistics account;
        const auto deposit = follow(scene, collimated<T>({0, 0, 1}, d), account);
        REQUIRE(deposit);
        const T facing = dot(d, shading), up = d.z - 2 * facing * shading.z;
        const bool allowed = facing < 0 && up > 0;
        CHECK(account.corrected_normals == (allowed ? 0 : 1));
        if (!allowed)
            check_close(deposit->direction, Vec<T>{d.x, 0, -d.z}, 8 * epsilon<T>);
        CHECK(deposit->direction.z > 0);
        CHECK(account.specular_events == 1);
        check_balance(account, 1, 1);
    }
}

// Out of glass at a low angle, and the shading normal all but faces the ray: refracted about it, the ray would go up,
// on the side that it came from. About the true normal it is reflected totally.
TEST_CASE_TEMPLATE("walk: a shading normal that throws refracted light back is corrected and counted", T, float,
                   double) {
    const BentMirror<T> scene{
        {{{{0, 0, 0}, {0, 0, 1}, Event::refract, T(1), T(1.5), 1}, {{0, 0, 2}, {0, 0, 1}, Event::deposit}}},
        {T(-0.8), 0, T(0.6)}};
    const Vec<T> d = normalize(Vec<T>{1, 0, T(-0.1)});
    Statistics account;
    const auto deposit = follow(scene, collimated<T>({0, 0, 1}, d), account);
    REQUIRE(deposit);
    CHECK(account.corrected_normals == 1);
    check_close(deposit->direction, Vec<T>{d.x, 0, -d.z}, 8 * epsilon<T>);
}

TEST_CASE_TEMPLATE("walk: a shading normal that keeps refracted light outside is corrected and counted", T, float,
                   double) {
    BentMirror<T> scene{
        {{{{0, 0, 0}, {0, 0, 1}, Event::refract, T(1), T(1.5), 1}, {{0, 0, -2}, {0, 0, 1}, Event::deposit}}}};
    // Out of glass, 34 degrees to the surface's normal but 9 to the shading one, which bends the ray up by little; and
    // one that the photon is behind.
    scene.shading = normalize(Vec<T>{T(0.9), 0, T(0.1)});
    const Vec<T> d = normalize(Vec<T>{T(0.5), 0, T(-1)});
    Statistics account;
    const auto deposit = follow(scene, collimated<T>({0, 0, 1}, d), account);
    REQUIRE(deposit);
    CHECK(account.corrected_normals == 1);
    check_close(deposit->direction, Vec<T>{T(1.5) * d.x, 0, -std::sqrt(1 - T(2.25) * d.x * d.x)}, 16 * epsilon<T>);
}

// A concave mirror of radius R about the origin, from inside at normal incidence: a parallel beam's tangent dx turns
// into dω = −2 dx / R. Outward normals and inward ones say the same surface: the walk flips dn with n.
TEST_CASE_TEMPLATE("walk: a curved mirror focuses alike whichever way its normals point", T, float, double) {
    struct Bowl {
        T side;
        std::optional<SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>> intersect(const Vec<T>& o, const Vec<T>& d, T,
                                                                           T) const {
            if (d.z < 0) { // the bowl's bottom, (0, 0, −2), radius 2; the shape operator of outward normals is 1/R
                const Vec<T> n{0, 0, -side};
                const T k = side / 2;
                return SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>{
                    (o.z + 2) / -d.z, {0, 0, -2}, n, n, {{k, 0, 0}, {0, k, 0}, {0, 0, 0}}, 0, 0};
            }
            const Vec<T> n{0, 0, 1}, zero{0, 0, 0};
            return SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>{
                T(0.5) - o.z, {0, 0, T(0.5)}, n, n, {zero, zero, zero}, 0, 1};
        }
        Scattering<T, T> scatter(const SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>& hit, const Vec<T>&, Constant&) const {
            return {hit.surface == 0 ? Event::reflect : Event::deposit, 1, 1};
        }
    };
    for (const T side : {T(1), T(-1)}) {
        Statistics account;
        const auto photon = collimated<T>({0, 0, 0}, {0, 0, -1});
        const auto deposit = follow(Bowl{side}, photon, account);
        REQUIRE(deposit);
        // The focus is R/2 above the mirror, the screen 2.5: (1 − 2.5) dx.
        for (std::size_t i = 0; i < 2; ++i)
            check_close(deposit->d_position[i], Vec<T>(T(-1.5) * photon.differential[i].d_position), 16 * epsilon<T>);
    }
}

namespace {

/// The mirror above, without what a hit may leave out; rays start where the scene says.
template <class T>
struct Spawner : SheetScene<T> {
    struct Hit {
        T distance;
        Vec<T> geometric_normal;
        Flat curvature;
        Vec<T> where;
        std::size_t surface;
    };
    std::optional<Hit> intersect(const Vec<T>& o, const Vec<T>& d, T t_min, T t_max) const {
        const auto hit = SheetScene<T>::intersect(o, d, t_min, t_max);
        return hit ? std::optional(Hit{hit->distance, hit->geometric_normal, {}, hit->position, hit->surface})
                   : std::nullopt;
    }
    template <class Sampler>
    Scattering<T, T> scatter(const Hit& hit, const Vec<T>&, Sampler&) const {
        return {this->sheets[hit.surface].event, this->sheets[hit.surface].weight, T(1)};
    }
    Vec<T> spawn(const Hit& hit, const Vec<T>& direction) const { return hit.where + T(1e-3) * direction; }
};
static_assert(!HasPosition<typename Spawner<float>::Hit, glm::vec3> &&
              !HasPositionError<typename Spawner<float>::Hit, glm::vec3>);

} // namespace

// Started 1e-3 further along, the ray arrives in the same place but is transferred over 1e-3 less.
TEST_CASE_TEMPLATE("walk: a scene that starts its own rays and knows nothing else does as well", T, float, double) {
    const auto photon = from_point<T>({T(0.25), -1, T(1.5)}, {1, T(0.5), -2});
    Statistics account, account_spawned;
    const auto deposit = follow(mirror_above_floor<T>(), photon, account);
    const auto spawned = follow(Spawner<T>{{mirror_above_floor<T>()}}, photon, account_spawned);
    REQUIRE(deposit);
    REQUIRE(spawned);
    check_close(spawned->position, deposit->position, 64 * epsilon<T>);
    check_close(spawned->direction, deposit->direction, 8 * epsilon<T>);
    for (std::size_t i = 0; i < 2; ++i)
        check_close(spawned->d_position[i], deposit->d_position[i], 1e-3 * 1.5 + 64 * epsilon<T>);
    CHECK(account_spawned.rays == account.rays);
}

// 1e5 units out a float resolves 1/128; a start too close to the surface would hit it again, and again.
TEST_CASE_TEMPLATE("walk: a ray leaves its surface far from the origin and at low angles", T, float, double) {
    for (const T far : {T(0), T(1e3), T(1e5)}) {
        const Vec<T> offset{far, -far, far};
        const Vec<T> normal = normalize(Vec<T>{T(0.3), T(-0.5), T(0.8)});
        SheetScene<T> scene{{{offset, normal, Event::reflect}, {offset + T(100) * normal, normal, Event::deposit}}};
        const auto [u, v] = frame_about(normal);
        for (const T height : {T(1), T(0.1), T(0.03)}) {
            Statistics account;
            const auto photon = collimated<T>(offset + T(10) * (height * normal - u), u - height * normal);
            const auto deposit = follow(scene, photon, account);
            CHECK(deposit.has_value());
            CHECK(account.specular_events == 1);
            CHECK(account.rays == 2);
        }
    }
}

// A surface that is known to a hundredth only, met steeply: the ray starts that far along its own line, and its
// tangents are those of the whole way. As in the first test, but for the rounding of the longer start.
TEST_CASE_TEMPLATE("walk: a ray that starts off its surface still has flown the whole way", T, float, double) {
    struct Rough : SheetScene<T> {
        std::optional<SurfaceHit<Vec<T>, Flat>> intersect(const Vec<T>& o, const Vec<T>& d, T t_min, T t_max) const {
            auto hit = SheetScene<T>::intersect(o, d, t_min, t_max);
            if (hit)
                hit->position_error = T(0.01);
            return hit;
        }
    };
    const auto photon = from_point<T>({T(0.25), -1, T(1.5)}, {1, T(0.5), -2}, T(1));
    Statistics account, account_rough;
    const auto deposit = follow(mirror_above_floor<T>(), photon, account);
    const auto rough = follow(Rough{mirror_above_floor<T>()}, photon, account_rough);
    REQUIRE(deposit);
    REQUIRE(rough);
    check_close(rough->position, deposit->position, 256 * epsilon<T>);
    for (std::size_t i = 0; i < 2; ++i)
        check_close(rough->d_position[i], deposit->d_position[i], 256 * epsilon<T>);
}

// A unit normal changes across itself. Where the geometric normal stands in for a shading one, so must its change: what
// the curvature says of the other normal is freed of its part along this one before Igehy's formula gets it.
TEST_CASE_TEMPLATE("walk: a corrected reflection differentiates about the normal that it used", T, float, double) {
    struct Corrected {
        std::optional<SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>> intersect(const Vec<T>& o, const Vec<T>& d, T,
                                                                           T) const {
            const bool mirror = d.z < 0;
            const T distance = mirror ? -o.z / d.z : (2 - o.z) / d.z;
            const Vec<T> n{0, 0, 1}, zero{0, 0, 0};
            const ShapeOperator<Vec<T>> bent{{T(0.3), T(0.1), T(0.5)}, {T(0.2), T(-0.4), T(0.7)}, zero};
            return SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>{distance,
                                                             o + distance * d,
                                                             n,
                                                             mirror ? Vec<T>{T(0.8), 0, T(0.6)} : n,
                                                             mirror ? bent : ShapeOperator<Vec<T>>{zero, zero, zero},
                                                             0,
                                                             mirror ? 0u : 1u};
        }
        Scattering<T, T> scatter(const SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>& hit, const Vec<T>&, Constant&) const {
            return {hit.surface == 0 ? Event::reflect : Event::deposit, 1, 1};
        }
    };
    const Vec<T> d = normalize(Vec<T>{1, 0, T(-0.5)}), zero{0, 0, 0};
    const Photon<Vec<T>, T> photon{{0, 0, 1}, d, 1, {Tangent<Vec<T>>{{1, 0, 0}, zero}, {{0, 1, 0}, zero}}};
    Statistics account;
    const auto deposit = follow(Corrected{}, photon, account);
    REQUIRE(deposit);
    REQUIRE(account.corrected_normals == 1);
    // dx is in the mirror's plane already; dn = (0.3, 0.1, 0) and (0.2, −0.4, 0); dω' = −2 [(ω·dn) n + (ω·n)
    // dn].
    const Vec<T> up{d.x, 0, -d.z};
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec<T> dn = i == 0 ? Vec<T>{T(0.3), T(0.1), 0} : Vec<T>{T(0.2), T(-0.4), 0};
        const Vec<T> turned{-2 * d.z * dn.x, -2 * d.z * dn.y, -2 * d.x * dn.x};
        const T flown = 2 / up.z;
        const Vec<T> moved = photon.differential[i].d_position + flown * turned;
        check_close(deposit->d_position[i], Vec<T>(moved - (moved.z / up.z) * up), 64 * epsilon<T> * 10);
    }
}

TEST_CASE_TEMPLATE("walk: refracted light starts on the other side", T, float, double) {
    // Two interfaces that coincide to rounding would be passed twice; here the second lies a thousand roundings behind.
    const T gap = 1024 * std::numeric_limits<T>::epsilon();
    const SheetScene<T> scene{{{{0, 0, 1}, {0, 0, 1}, Event::refract, 1, 1, T(1.5)},
                               {{0, 0, 1 - gap}, {0, 0, 1}, Event::refract, 1, T(1.5), 1},
                               {{0, 0, 0}, {0, 0, 1}, Event::deposit}}};
    Statistics account;
    const auto deposit = follow(scene, collimated<T>({0, 0, 2}, {T(0.5), 0, -1}), account);
    REQUIRE(deposit);
    CHECK(account.specular_events == 2);
    check_close(deposit->direction, normalize(Vec<T>{T(0.5), 0, -1}), 16 * epsilon<T>);
}

} // namespace nephroid::tests::walk_surfaces_test
