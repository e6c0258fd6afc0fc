// SPDX-License-Identifier: MIT
// What no renderer should answer, and what becomes of it: never a wrong picture without a word. The table is in
// tests/README.md, "Nonsense and its answers".
#include "nephroid/caustics.hpp"
#include "nephroid/differential/finite_difference_curvature.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/gather/trace_photons.hpp"
#include "transport/follow.hpp"

#include "support/vertex.hpp"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::nonsense_test {

using tests::check_balance;
using tests::collimated;
using tests::follow;
using tests::mirror_above_floor;
using tests::quiet_nan;
using tests::SheetScene;

namespace {

using V = tests::Vec<double>;
using PlaneHit = SurfaceHit<V, Flat>;

/// A mirror over a floor, or a pane of glass, whose answers are changed.
struct Changed {
    SheetScene<double> sheets = mirror_above_floor<double>();
    std::function<void(PlaneHit&)> change_hit = [](PlaneHit&) {};
    std::function<void(Scattering<double, double>&)> change_scattering = [](auto&) {};

    [[nodiscard]] std::optional<PlaneHit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        auto hit = sheets.intersect(o, d, t_min, t_max);
        if (hit)
            change_hit(*hit);
        return hit;
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const PlaneHit& hit, const V& d, Sampler& sampler) const {
        auto scattering = sheets.scatter(hit, d, sampler);
        if (scattering.event != Event::deposit)
            change_scattering(scattering);
        return scattering;
    }
};

[[nodiscard]] Changed with_hit(const std::function<void(PlaneHit&)>& change) {
    Changed scene;
    scene.change_hit = change;
    return scene;
}
[[nodiscard]] Changed with_scattering(const std::function<void(Scattering<double, double>&)>& change) {
    Changed scene;
    scene.change_scattering = change;
    return scene;
}

/// The one photon ends as invalid, with its flux in the account.
void check_invalid(const Changed& scene,
                   const Photon<V, double>& photon = collimated<double>({0, 0, 1}, {0.3, 0, -1})) {
    Statistics account;
    CHECK_FALSE(follow(scene, photon, account).has_value());
    CHECK(account[Fate::invalid].photons == 1);
    CHECK(account[Fate::invalid].flux == 1);
    check_balance(account);
}

void check_valid(const Changed& scene, const Photon<V, double>& photon = collimated<double>({0, 0, 1}, {0.3, 0, -1})) {
    Statistics account;
    CHECK(follow(scene, photon, account).has_value());
    CHECK(account[Fate::invalid].photons == 0);
}

template <class Call>
[[nodiscard]] std::string refusal_of(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "not refused";
}

[[nodiscard]] bool says(const std::string& sentence, const char* what) {
    CAPTURE(sentence);
    return sentence.find(what) != std::string::npos;
}

/// A kernel that is too large by a factor.
struct Scaled {
    static constexpr double second_moment = BiweightKernel::second_moment;
    double factor = 1;
    template <Scalar T>
    [[nodiscard]] T operator()(const T& radius2) const {
        return T(factor) * BiweightKernel{}(radius2);
    }
};

/// A cylinder about the y axis above which a tracer like many others skips what is nearer than its epsilon.
struct Skipping {
    double epsilon;
    [[nodiscard]] std::optional<PlaneHit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const double a = d.x * d.x + d.z * d.z, b = o.x * d.x + o.z * d.z, c = o.x * o.x + o.z * o.z - 1;
        const double root = b * b - a * c;
        if (!(root >= 0) || !(a > 0))
            return std::nullopt;
        for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
            if (t > (std::max)(t_min, epsilon) && t < t_max) {
                const V at = o + t * d, n{at.x, 0, at.z};
                return PlaneHit{t, at, n, n, Flat{}, 1e-14, 1};
            }
        return std::nullopt;
    }
};
struct SkippingAndSaying : Skipping {
    double tracer_epsilon;
};

/// Reflects and refracts shares of the light that add up to a sum.
struct InShares : Changed {
    double shares;
    [[nodiscard]] Ways<Scattering<double, double>> scatter_all(const PlaneHit& hit, const V&) const {
        if (hit.surface != 0)
            return Scattering<double, double>::deposit();
        return {Scattering<double, double>::reflect(0.5 * shares),
                Scattering<double, double>::refract(0.5 * shares, 1.0)};
    }
};

/// The same with a share for each band. Flux has the type of vectors here.
struct InBands : Changed {
    V shares;
    template <class Sampler>
    [[nodiscard]] Scattering<V, double> scatter(const PlaneHit&, const V&, Sampler&) const {
        return Scattering<V, double>::deposit();
    }
    [[nodiscard]] Ways<Scattering<V, double>> scatter_all(const PlaneHit& hit, const V&) const {
        if (hit.surface != 0)
            return Scattering<V, double>::deposit();
        return {Scattering<V, double>::reflect(0.5 * shares), Scattering<V, double>::refract(0.5 * shares, 1.0)};
    }
};
struct BandDeposits {
    static constexpr bool follows_all_ways = true;
    V flux{0, 0, 0};
    void deposit(const Deposit<V, V, 2>& deposit, const WalkedPath<>&) { flux = flux + deposit.flux; }
};

/// Follows all ways, and adds up what arrives.
struct Deposits {
    static constexpr bool follows_all_ways = true;
    double flux = 0;
    void deposit(const Deposit<V, double, 2>& deposit, const WalkedPath<>&) { flux += deposit.flux; }
};

} // namespace

TEST_CASE("nonsense: an index that is no number or not positive ends the photon as invalid") {
    for (const double eta : {quiet_nan<double>, 0.0, -1.5, std::numeric_limits<double>::infinity()}) {
        CAPTURE(eta);
        check_invalid(with_scattering([eta](auto& s) {
            s.event = Event::refract;
            s.eta = eta;
        }));
    }
    check_valid(with_scattering([](auto& s) { s.eta = quiet_nan<double>; })); // a mirror has none: it is not looked at
}

TEST_CASE("nonsense: a negative or endless weight ends the photon as invalid") {
    for (const double weight : {-1.0, -1e-9, quiet_nan<double>, std::numeric_limits<double>::infinity()}) {
        CAPTURE(weight);
        check_invalid(with_scattering([weight](auto& s) { s.weight = weight; }));
    }
    check_valid(with_scattering([](auto& s) { s.weight = 0.5; }));
}

TEST_CASE("nonsense: negative light in one band alone is found too") {
    CHECK(detail::has_negative_band(tests::Vec<float>{1, -0.1f, 1}));
    CHECK_FALSE(detail::has_negative_band(tests::Vec<float>{1, 0, 1}));
    CHECK(detail::has_negative_band(-1e-20f));
}

TEST_CASE("nonsense: normals that are not unit end the photon as invalid") {
    for (const double size : {0.0, 0.5, 0.98, 1.02, 3.0, quiet_nan<double>}) {
        CAPTURE(size);
        check_invalid(with_hit([size](PlaneHit& hit) { hit.geometric_normal *= size; }));
        check_invalid(with_hit([size](PlaneHit& hit) { hit.shading_normal *= size; }));
    }
    for (const double size : {0.9995, 1.0005}) // as packed normals have it
        check_valid(with_hit([size](PlaneHit& hit) { hit.geometric_normal *= size, hit.shading_normal *= size; }));
}

TEST_CASE("nonsense: a light whose directions are not unit emits invalid photons") {
    for (const double size : {0.0, 0.9, 1.02, 2.0, quiet_nan<double>}) {
        CAPTURE(size);
        auto photon = collimated<double>({0, 0, 1}, {0.3, 0, -1});
        photon.direction *= size;
        check_invalid(Changed{}, photon);
    }
}

TEST_CASE("nonsense: distances that are negative or no numbers end the photon as invalid") {
    check_invalid(with_hit([](PlaneHit& hit) { hit.distance = -hit.distance; }));
    check_invalid(with_hit([](PlaneHit& hit) { hit.distance = quiet_nan<double>; }));
}

// A hit that claims to be exact is taken to be as exact as its coordinates: no photon is caught by the mirror it left.
TEST_CASE("nonsense: a position error of zero is taken for that of rounding, and a negative one is invalid") {
    for (const double error : {-1.0, quiet_nan<double>})
        check_invalid(with_hit([error](PlaneHit& hit) { hit.position_error = error; }));
    for (const double error : {0.0, 1e-300}) {
        CAPTURE(error);
        Changed scene = with_hit([error](PlaneHit& hit) { hit.position_error = error; });
        const V away{10.1, -20.3, 7.7}, tilt = normalize(V{0.3, 0.2, 1});
        for (auto& sheet : scene.sheets.sheets)
            sheet.centre += away, sheet.normal = tilt;
        scene.sheets.sheets[1].centre += 2.0 * tilt;
        Statistics account;
        for (int i = 0; i < 1000; ++i) {
            const V at = away + tilt + V{0.001 * i, 0.0003 * i, 0};
            const auto photon = collimated<double>(at, -tilt + V{0.01, 0.0007 * i, 0});
            if (const auto deposit = follow(scene, photon, account))
                account.end(Fate::splatted, deposit->flux);
        }
        CHECK(account[Fate::splatted].photons == 1000);
        CHECK(account.specular_events == 1000);
        CHECK(account.hits_at_start == 0);
    }
}

TEST_CASE("nonsense: more photons in a pass than in all, bad executors and bad kernels are refused") {
    std::vector<tests::Vertex<V>> floor{{{0, 0, 2}, {0, 0, -1}}};
    const EyePathMap map(floor, &tests::Vertex<V>::position, &tests::Vertex<V>::normal);
    const DirectionalLight<V, double> sun(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = BeamDisk<V>{{0, 0, 1}, 1}});
    const auto refused = [&](const PhotonPass& pass, auto&&... arguments) {
        return refusal_of([&] {
            auto sums = nephroid::sums<double>(map);
            (void)caustics(mirror_above_floor<double>(), sun, sums, pass, arguments...);
        });
    };
    CHECK(says(refused({.count = 100, .total = 50}), "count is 100 and total 50"));
    CHECK(refused({.count = 100, .total = 100}) == "not refused");
    CHECK(refused({.count = 100}) == "not refused");

    const auto twice = [](std::size_t count, auto&& task) {
        for (std::size_t i = 0; i < 2 * count; ++i)
            task(i / 2);
    };
    const auto never = [](std::size_t, auto&&) {};
    CHECK(says(refused({.count = 100}, twice), "ran a task twice"));
    CHECK(says(refused({.count = 100}, never), "ran 0 of"));
    CHECK(says(refusal_of([&] {
                   (void)trace_photons(mirror_above_floor<double>(), sun, {.count = 100}, HaltonSequence{}, never);
               }),
               "ran 0 of"));

    CHECK(says(refused({.count = 100}, Default{}.with_kernel(Scaled{2})), "integral over the unit disk is 2"));
    CHECK(says(refused({.count = 100}, Default{}.with_kernel(Scaled{0.9})), "integral over the unit disk is 0.9"));
    CHECK(refused({.count = 100}, Default{}.with_kernel(Scaled{1})) == "not refused");
}

TEST_CASE("nonsense: each kernel of the library holds its flux") {
    const auto check = [](const auto& kernel) {
        CHECK(detail::kernel_integral(kernel) == doctest::Approx(1).epsilon(2e-4));
        CHECK_NOTHROW(detail::check_kernel(kernel));
    };
    check(BiweightKernel{});
    check(EpanechnikovKernel{});
    check(ConeKernel{});
    check(UniformKernel{});
    check(TruncatedGaussianKernel{});
}

TEST_CASE("nonsense: a tracer's epsilon that is negative or no number makes photons invalid") {
    struct Epsilon : Changed {
        double tracer_epsilon;
    };
    for (const double epsilon : {-0.001, quiet_nan<double>, 0.0}) {
        CAPTURE(epsilon);
        const Epsilon scene{{}, epsilon};
        Statistics account;
        const bool is_lit = follow(scene, collimated<double>({0, 0, 1}, {0.3, 0, -1}), account).has_value();
        CHECK(is_lit == (epsilon == 0));
        CHECK(account[Fate::invalid].photons == (epsilon == 0 ? 0 : 1));
    }
}

TEST_CASE("nonsense: ways whose shares add up to more than 1 make the photon invalid") {
    for (const double shares : {1.0, 0.8, 1 + 1e-9, 1.01, 2.0, -1.0, quiet_nan<double>}) {
        CAPTURE(shares);
        const InShares scene{{}, shares};
        Deposits deposits;
        tests::Constant numbers;
        Statistics account;
        walk(scene, collimated<double>({0, 0, 1}, {0.3, 0, -1}), numbers, {}, account, deposits);
        const bool is_valid = shares > 0 && shares < 1.001;
        CHECK((account[Fate::invalid].photons == 1) == !is_valid);
        CHECK(deposits.flux == doctest::Approx(is_valid ? 0.5 * shares : 0)); // what is reflected; below is nothing
    }
}

TEST_CASE("nonsense: ways that create light in one band make the photon invalid, whatever the others lose") {
    const V arrived{1, 0, 2};
    CHECK_FALSE(detail::has_band_above(V{0.5, 0, 2}, arrived, 1.001));
    CHECK_FALSE(detail::has_band_above(V{1.0009, 0, 2.0009}, arrived, 1.001));
    CHECK(detail::has_band_above(V{1.01, 0, 0}, arrived, 1.001)); // its power is less than that of what arrived
    CHECK(detail::has_band_above(V{0, 0.01, 0}, arrived, 1.001));
    CHECK(detail::has_band_above(V{0, 0, 2.01}, arrived, 1.001));
    for (const double red : {1.0, 1.01}) {
        CAPTURE(red);
        const InBands scene{{}, {red, 0.25, 0.25}};
        BandDeposits deposits;
        tests::Constant numbers;
        Statistics account;
        const auto grey = collimated<double>({0, 0, 1}, {0.3, 0, -1});
        const Photon<V, V, 2> photon{grey.position, grey.direction, V{1, 1, 1}, grey.differential};
        walk(scene, photon, numbers, {}, account, deposits);
        CHECK((account[Fate::invalid].photons == 1) == (red > 1.001));
        CHECK(deposits.flux.x == doctest::Approx(red > 1.001 ? 0 : 0.5));
    }
}

// The normal of a cylinder of radius 1 turns by dx across its axis.
TEST_CASE("nonsense: probes of a tracer that skips more than they are long are answered if it says so") {
    const V top{0, 0, 1};
    const PlaneHit hit{1, top, top, top, Flat{}, 1e-14, 1};
    const Skipping silent{0.01};
    CHECK_FALSE(all_finite(finite_difference_curvature(silent, hit, 1.0)(V{1, 0, 0}))); // counted as invalid
    const SkippingAndSaying saying{{0.01}, 0.01};
    const V turn = finite_difference_curvature(saying, hit, 1.0)(V{1, 0, 0});
    CHECK(std::abs(turn.x - 1) < 1e-8);
    CHECK(std::abs(turn.z) < 1e-8);
}

} // namespace nephroid::tests::nonsense_test
