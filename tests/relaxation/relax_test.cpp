// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/relax.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/relaxation/detect_features.hpp"

#include "relaxation/cloud.hpp"
#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <limits>
#include <optional>
#include <string>

namespace nephroid::tests::relax_test {

using namespace nephroid::detail;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class P>
RelaxationReport run(std::vector<P>& photons, const RelaxationOptions& options) {
    return relax(photons, access_to<P>(), options, SerialExecutor{});
}

template <class P>
bool all_photons_finite(const std::vector<P>& photons) {
    return std::all_of(photons.begin(), photons.end(), [](const P& p) { return all_finite(p.position); });
}

/// One photon's move, from eq. 1 to 3 and 11 in wide precision and from all distances.
/// @param limit_radius  r_p
Space expected_move(const std::vector<Stored>& photons, std::size_t i, double lambda, double rho, double limit_radius) {
    const auto all = distances(photons, i);
    const Space x = widen(photons[i].position), n = widen(photons[i].normal);
    const Wide reach = Wide(lambda) * Wide(all[6].first);
    Space force{0, 0, 0};
    for (int k = 0; k < 6; ++k) {
        const Space offset = x - widen(photons[all[std::size_t(k)].second].position);
        const Wide d = offset.length();
        force = force + (reach / d - d / reach) * offset;
    }
    force = (Wide(1) / Wide(6)) * force.across(n);
    const double ratio = rho > 0 ? static_cast<double>(force.length()) / limit_radius / rho : 0;
    return Wide(std::exp2(-ratio * ratio)) * force;
}

/// Photons moved in turn, as the tree of where they begin says: every fourth leaf has the same turn, in which it sees
/// the other leaves as they were before, and photons of its own as they are by now, but for the last.
/// @param radius  of each photon's neighbourhood; r_p of eq. 11 unless empty, and then what it is now
std::vector<Stored> moved_in_turn(const std::vector<Stored>& order, std::vector<Stored> photons, double lambda,
                                  double rho, double fraction, std::vector<double>& radius) {
    const PhotonCloud<glm::dvec3, double> cloud(order, access_to<Stored>(), 0.5, "test");
    const std::vector<double> limits = radius;
    radius.resize(photons.size());
    const auto& leaves = cloud.tree().leaves();
    for (std::size_t turn = 0; turn < 4; ++turn) {
        const auto before = photons;
        for (std::size_t leaf = turn; leaf < leaves.size(); leaf += 4) {
            auto seen = before;
            std::optional<std::size_t> last; // its move is not seen yet
            for (std::size_t slot = leaves[leaf].first; slot < leaves[leaf].first + leaves[leaf].size; ++slot) {
                const std::size_t i = cloud.tree().index(slot);
                radius[i] = distances(seen, i)[6].first;
                const double limit = limits.empty() ? radius[i] : limits[i];
                const Space to = widen(seen[i].position) + Wide(fraction) * expected_move(seen, i, lambda, rho, limit);
                photons[i].position = narrow<glm::dvec3>(to);
                if (last)
                    seen[*last].position = photons[*last].position;
                last = i;
            }
        }
    }
    return photons;
}

/// The largest distance between the same photons of two maps.
double farthest_apart(const std::vector<Stored>& a, const std::vector<Stored>& b) {
    double farthest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        farthest = std::max(farthest, length(a[i].position - b[i].position));
    return farthest;
}

/// The mean distance to the nearest other photon over that of as many random ones, 1/(2 √n), away from the border.
template <class P>
double nearest_distance(const std::vector<P>& photons) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const auto& p = photons[i].position;
        if (std::abs(double(p.x) - 0.5) > 0.4 || std::abs(double(p.y) - 0.5) > 0.4)
            continue;
        sum += distances(photons, i).front().first;
        ++count;
    }
    return sum / count * 2 * std::sqrt(double(photons.size()));
}

/// The share of photons left of 0.5 that lie between there and 0.5 + width, and those that came from the dense side.
double crossed(const std::vector<Stored>& before, const std::vector<Stored>& after) {
    double count = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        count +=
            before[i].position.x < 0.5 && after[i].position.x > 0.502 && std::abs(before[i].position.y - 0.5) < 0.4;
    return count;
}

} // namespace

// Coordinates relative to the map's middle, distances of 0.03, two dozen roundings; each photon hands its own on to
// those after it, and forces between near ones amplify them.
TEST_CASE("relaxation: the first iteration moves photons one after another as the formulas say") {
    const auto start = random_floor(400, 71);
    for (const double rho : {0.0, 0.3})
        for (const double lambda : {1.0, 2.0}) {
            auto photons = start;
            run(photons, {.iterations = 1, .over_relaxation = lambda, .constrain = false, .rho = rho, .leash = 16});
            std::vector<double> radius;
            CHECK(farthest_apart(photons, moved_in_turn(start, start, lambda, rho, 1, radius)) <= 1e-11);
        }
}

TEST_CASE("relaxation: the second iteration damps moves by the radius of the first") {
    const auto start = random_floor(300, 72);
    // Two iterations, of which the second follows half of its force and λ has come down to 1.2 + 0.8 exp(−1.5).
    auto photons = start;
    run(photons, {.iterations = 2, .final_step = 0.5, .constrain = false, .leash = 16});
    std::vector<double> radius;
    const auto first = moved_in_turn(start, start, 2, 0.3, 1, radius);
    const auto both = moved_in_turn(start, first, 1.2 + 0.8 * std::exp(-1.5), 0.3, 0.5, radius);
    CHECK(farthest_apart(photons, both) <= 1e-10);
}

/// The standard deviation of estimates from 20 neighbours with an Epanechnikov kernel over their mean, on even light
/// and away from its border.
double noise_of(const std::vector<Stored>& photons) {
    double sum = 0, sum2 = 0, count = 0;
    for (double x = 0.2; x < 0.8; x += 0.03)
        for (double y = 0.2; y < 0.8; y += 0.03) {
            std::vector<double> distance2;
            for (const Stored& photon : photons)
                distance2.push_back(length2(glm::dvec3(photon.position - glm::dvec3(x, y, 0))));
            std::nth_element(distance2.begin(), distance2.begin() + 19, distance2.end());
            double estimate = 0;
            for (int k = 0; k < 19; ++k)
                estimate += 1 / distance2[19] - distance2[std::size_t(k)] / (distance2[19] * distance2[19]);
            sum += estimate, sum2 += estimate * estimate, ++count;
        }
    return std::sqrt(sum2 / count - sum * sum / (count * count)) / (sum / count);
}

/// One iteration in the paper's order, photon by photon, with λ = 1.
void move_one_after_another(std::vector<Stored>& photons, std::vector<double>& radius) {
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const double r = distances(photons, i)[6].first;
        photons[i].position = narrow<glm::dvec3>(widen(photons[i].position) +
                                                 expected_move(photons, i, 1, 0.3, radius[i] > 0 ? radius[i] : r));
        radius[i] = r;
    }
}

// Over eight maps of 700 photons the ratio of the two means varies by some 3%; photons that all move at once have 1.3.
TEST_CASE("relaxation: ten iterations leave as little noise as if photons moved one after another") {
    double ours = 0, theirs = 0;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        auto photons = random_floor(700, 120 + seed), one_by_one = photons;
        run(photons, {.iterations = 10, .over_relaxation = 1, .final_relaxation = 1, .constrain = false, .leash = 16});
        std::vector<double> radius(photons.size());
        for (int i = 0; i < 10; ++i)
            move_one_after_another(one_by_one, radius);
        ours += noise_of(photons), theirs += noise_of(one_by_one);
    }
    CHECK(ours / theirs < 1.1);
    CHECK(ours / theirs > 0.9);
}

TEST_CASE("relaxation: photons stay in their tangent planes whichever way these lie") {
    Draws draw(73);
    const Space n = draw.direction(), u = draw.direction().across(n).unit(), v = n.cross(u);
    std::vector<Stored> photons;
    for (int i = 0; i < 500; ++i) {
        const double x = draw.in(0, 1);
        photons.push_back({i, narrow<glm::dvec3>(Wide(x) * u + Wide(draw.in(0, 1)) * v), narrow<glm::dvec3>(n), 1});
    }
    const auto start = photons;
    const auto report = run(photons, {});
    CHECK_FALSE(same_positions(start, photons));
    for (const Stored& photon : photons)
        CHECK(std::abs(static_cast<double>(widen(photon.position).dot(n))) < 1e-13);
    CHECK(report.photons == 500);
    CHECK(report.iterations == 20);
    CHECK(report.mean_step.size() == 20);
    CHECK(report.mean_step.back() < 0.1);
}

// The nearest of random photons is at 1/(2 √n) on average; on a hexagonal lattice at 1.0746/√n, 2.15 times as far.
// Blue noise lies between, over-relaxed photons, which form cells, nearer to each other than others: of 1280 random
// ones the mean varies by 0.52/√1280 = 0.015 of itself.
TEST_CASE_TEMPLATE("relaxation: random photons come to lie evenly apart", T, float, double) {
    using V = glm::vec<3, T>;
    auto photons = random_floor<V>(2000, 74);
    CHECK(nearest_distance(photons) == doctest::Approx(1).epsilon(0.06));
    auto cells = photons;
    run(cells, {.iterations = 30});
    CHECK(nearest_distance(cells) > 1.25);
    run(photons, {.iterations = 30, .over_relaxation = 1, .final_relaxation = 1});
    CHECK(nearest_distance(photons) > 1.5);
    CHECK(nearest_distance(photons) < 2.15);
}

/// The power of a map's low frequencies, below half the principal one, over that of white noise; a Hann window keeps
/// what the border does out of it.
double low_power(const std::vector<Stored>& photons) {
    const double pi2 = 2 * std::numbers::pi, principal = std::sqrt(2 / std::sqrt(3.0) * double(photons.size()));
    double sum = 0, count = 0;
    const int limit = int(principal / 2);
    for (int a = 0; a <= limit; ++a)
        for (int b = -limit; b <= limit; ++b) {
            const double f = std::hypot(a, b);
            if (f < 3 || f > principal / 2)
                continue; // the window itself reaches up to √2
            std::complex<double> wave(0);
            for (const Stored& photon : photons) {
                const auto& p = photon.position;
                if (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1)
                    continue;
                const double window = (1 - std::cos(pi2 * p.x)) * (1 - std::cos(pi2 * p.y));
                wave += std::polar(window, pi2 * (a * p.x + b * p.y));
            }
            sum += std::norm(wave) / (2.25 * double(photons.size())); // the mean of the squared window
            ++count;
        }
    return sum / count;
}

TEST_CASE("relaxation: low frequencies fall by more than ten decibels with and without over-relaxation") {
    for (const bool over : {true, false}) {
        auto photons = random_floor(800, 75);
        const double before = low_power(photons);
        CHECK(before > 0.7); // 1 on average over some 180 independent frequencies
        CHECK(before < 1.4);
        RelaxationOptions options{.iterations = 50};
        if (!over)
            options.over_relaxation = options.final_relaxation = 1;
        run(photons, options);
        CHECK(10 * std::log10(low_power(photons)) < -10);
    }
}

TEST_CASE("relaxation: an edge stays where it is and without constraints it flows away") {
    const auto start = stepped_floor(5000, 76);
    auto held = start, limited = start, loose = start;
    CHECK(run(held, {}).constrained_photons > 200);
    run(limited, {.constrain = false});
    run(loose, {.constrain = false, .rho = 0});
    CHECK(crossed(start, held) < 15);
    CHECK(crossed(start, limited) > 60);
    CHECK(crossed(start, loose) > crossed(start, limited));
}

TEST_CASE("relaxation: photons at the border do not drift off") {
    for (const bool constrain : {true, false})
        for (const double rho : {0.3, 0.0}) {
            const auto start = random_floor(1000, 77);
            auto photons = start;
            run(photons, {.iterations = 50, .constrain = constrain, .rho = rho});
            double farthest = 0;
            for (std::size_t i = 0; i < photons.size(); ++i)
                farthest =
                    std::max(farthest, length(photons[i].position - start[i].position) / distances(start, i)[6].first);
            CHECK(farthest <= 2 * (1 + 1e-12)); // the leash
        }
}

TEST_CASE("relaxation: only positions change and no photon is lost") {
    auto photons = random_floor(500, 78);
    for (Stored& photon : photons)
        photon.flux = 1.0 / (1 + photon.number);
    const auto start = photons;
    run(photons, {});
    REQUIRE(photons.size() == start.size());
    for (std::size_t i = 0; i < photons.size(); ++i) {
        CHECK(photons[i].number == start[i].number);
        CHECK(photons[i].normal == start[i].normal);
        CHECK(photons[i].flux == start[i].flux);
    }
    auto again = start;
    CHECK(run(again, {.iterations = 0}).iterations == 0);
    CHECK(same_positions(again, start));
}

TEST_CASE("relaxation: is the same bit for bit for any number of threads") {
    const auto start = stepped_floor(3000, 79);
    const RelaxationOptions options{.iterations = 10, .flux_diffusion = FluxDiffusion::conserving};
    auto serial = start;
    run(serial, options);
    for (const unsigned count : {2u, 5u}) {
        ThreadExecutor threads(count);
        auto parallel = start;
        const auto report = relax(parallel, access_to<Stored>(), options, threads);
        CHECK(same_positions(parallel, serial));
        auto again = start;
        CHECK(report.mean_step == run(again, options).mean_step);
    }
}

TEST_CASE("relaxation: flux is evened out on the way if asked for and its total stays") {
    auto photons = random_floor(1000, 80);
    double before = 0, after = 0, spread = 0;
    for (Stored& photon : photons)
        before += photon.flux = photon.number % 2;
    run(photons, {.flux_diffusion = FluxDiffusion::conserving});
    for (const Stored& photon : photons)
        after += photon.flux, spread += std::pow(photon.flux - 0.5, 2) / 1000;
    CHECK(std::abs(after - before) <= 1000 * 7 * 20 * 1.2e-16);
    CHECK(spread < 0.08); // from 0.25
}

TEST_CASE("relaxation: any vectors and any way to reach a photon's parts will do") {
    for_each_vector<float>([]<class V>() {
        using t = vector_traits<V>;
        auto photons = random_floor<V>(200, 81);
        const auto start = photons;
        run(photons, {.iterations = 3});
        double moved = 0;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            moved += std::abs(double(t::x(photons[i].position)) - double(t::x(start[i].position)));
            CHECK(t::z(photons[i].position) == 0);
        }
        CHECK(moved > 0.01);
    });
    struct Odd {
        glm::vec3 data[2];
        double watts;
    };
    std::vector<Odd> photons;
    for (const auto& p : random_floor<glm::vec3>(100, 82))
        photons.push_back({{p.position, p.normal}, 1.0});
    const auto access = photon_access(
        [](auto& p) -> auto& { return p.data[0]; }, [](const Odd& p) { return p.data[1]; }, &Odd::watts);
    CHECK(relax(photons, access, RelaxationOptions{.iterations = 2}, SerialExecutor{}).photons == 100);
    static_assert(MovesPhotons<decltype(access), std::vector<Odd>>);
    static_assert(!MovesPhotons<decltype(access), const std::vector<Odd>>);
    const auto copying =
        photon_access([](const Odd& p) { return p.data[0]; }, [](const Odd& p) { return p.data[1]; }, &Odd::watts);
    static_assert(ReadsPhotons<decltype(copying), std::vector<Odd>>);
    static_assert(!MovesPhotons<decltype(copying), std::vector<Odd>>);
    static_assert(ReadsPhotons<decltype(access), const std::vector<Odd>>);
    static_assert(!ReadsPhotons<PhotonAccess<double Odd::*, double Odd::*, double Odd::*>, std::vector<Odd>>);
}

TEST_CASE("relaxation: the caller may put photons back on a curved surface") {
    Draws draw(83);
    std::vector<Stored> photons;
    for (int i = 0; i < 1000; ++i) { // on a sphere about (5, 0, 0)
        const auto n = narrow<glm::dvec3>(draw.direction());
        photons.push_back({i, n + glm::dvec3(5, 0, 0), n, 1});
    }
    const auto to_sphere = [](std::size_t, const glm::dvec3& p) {
        const glm::dvec3 offset = p - glm::dvec3(5, 0, 0);
        return (1 / length(offset)) * offset + glm::dvec3(5, 0, 0);
    };
    relax(photons, access_to<Stored>(), {.iterations = 10}, SerialExecutor{}, to_sphere);
    double nearest = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        CHECK(std::abs(length(photons[i].position - glm::dvec3(5, 0, 0)) - 1) < 1e-14);
        nearest += distances(photons, i).front().first / 1000;
    }
    CHECK(nearest * 2 * std::sqrt(1000 / (4 * std::numbers::pi)) > 1.25);
    const auto astray = [](std::size_t photon, const glm::dvec3& p) {
        return photon == 17 ? glm::dvec3(not_a_number) : p;
    };
    CHECK_THROWS_WITH(relax(photons, access_to<Stored>(), {}, SerialExecutor{}, astray),
                      "nephroid::relax: project put photon 17 at (nan, nan, nan); every position must be finite");
}

TEST_CASE("relaxation: progress is told after each iteration and may stop it") {
    auto photons = random_floor(200, 84), twice = photons;
    std::vector<unsigned> told;
    const auto report = relax(photons, access_to<Stored>(), {.iterations = 10}, SerialExecutor{}, StayInPlane{},
                              [&](unsigned iteration) {
                                  told.push_back(iteration);
                                  return iteration < 1;
                              });
    CHECK(told == std::vector<unsigned>{0, 1});
    CHECK(report.iterations == 2);
    CHECK_FALSE(same_positions(photons, twice));
}

TEST_CASE("relaxation: no photon and a few photons are no trouble") {
    std::vector<Stored> nobody;
    CHECK(run(nobody, {}).photons == 0);
    CHECK(run(nobody, {}).iterations == 0);
    for (int count = 1; count <= 9; ++count)
        for (const bool constrain : {true, false}) {
            auto photons = random_floor(count, std::uint32_t(85 + count));
            const auto start = photons;
            run(photons, {.iterations = 50, .constrain = constrain, .rho = 0});
            CHECK(all_photons_finite(photons));
            if (count <= 2)
                CHECK(same_positions(photons, start)); // nothing tells how far apart they should be
        }
}

TEST_CASE("relaxation: photons on a line stay on it if their force does") {
    Draws draw(95);
    std::vector<Stored> photons;
    for (int i = 0; i < 300; ++i)
        photons.push_back(floor_photon(draw.in(0, 1), 0, i));
    auto held = photons;
    run(photons, {.iterations = 50, .constrain = false});
    for (const Stored& photon : photons)
        CHECK(photon.position.y == 0);
    run(held, {.iterations = 50});
    CHECK(all_photons_finite(held));
}

TEST_CASE_TEMPLATE("relaxation: photons in the same place part the same way each time", T, float, double) {
    using V = glm::vec<3, T>;
    auto photons = random_floor<V>(400, 96);
    for (std::size_t i = 0; i < 200; i += 2)
        photons[i].position = photons[i + 1].position; // pairs
    for (std::size_t i = 200; i < 230; ++i)
        photons[i].position = photons[200].position; // and thirty
    auto again = photons;
    auto held = photons; // by the feature that thirty photons in one place are
    run(held, {});
    CHECK(all_photons_finite(held));
    run(photons, {.constrain = false});
    run(again, {.constrain = false});
    CHECK(same_positions(photons, again));
    CHECK(all_photons_finite(photons));
    std::size_t together = 0;
    for (std::size_t i = 0; i < photons.size(); ++i)
        together += distances(photons, i).front().first == 0;
    CHECK(together == 0);
}

TEST_CASE_TEMPLATE("relaxation: all photons in one place stay there", T, float, double) {
    using V = glm::vec<3, T>;
    std::vector<StoredPhoton<V>> photons(5000, floor_photon<V>(0.25, 0.75));
    const auto start = photons;
    run(photons, {});
    CHECK(same_positions(photons, start));
}

// The other side's photons are denser: they would push were they not on the other side. A leaf of the tree holds 64
// photons, so all move in the order of their numbers whether the other side is there or not.
TEST_CASE("relaxation: the two sides of a thin wall do not feel each other") {
    auto upper = random_floor(20, 97);
    auto lower = random_floor(40, 98);
    for (Stored& photon : lower)
        photon.position.z = -1e-4, photon.normal = {0, 0, -1};
    auto both = upper;
    both.insert(both.end(), lower.begin(), lower.end());
    run(both, {.iterations = 10, .constrain = false});
    run(upper, {.iterations = 10, .constrain = false});
    // The origin that coordinates are relative to differs: the same to rounding that iterations amplify.
    CHECK(farthest_apart(upper, both) < 1e-9);
}

TEST_CASE("relaxation: photons that cannot be are refused by their number") {
    for (const double bad : {not_a_number, infinity}) {
        auto photons = random_floor(30, 99);
        photons[12].position.y = bad;
        const auto start = photons;
        const std::string value = std::isnan(bad) ? "nan" : "inf";
        const std::string message = [&] {
            try {
                run(photons, {});
            } catch (const std::invalid_argument& error) {
                return std::string(error.what());
            }
            return std::string("nothing");
        }();
        CHECK(message.find("nephroid::relax: point 12 is at (") == 0);
        CHECK(message.find(value) != std::string::npos);
        CHECK(same_positions(photons, start));
    }
    auto photons = random_floor(30, 100);
    photons[7].normal = {0, 0, 2};
    CHECK_THROWS_WITH(run(photons, {}),
                      "nephroid::relax: photon 7 has the normal (0, 0, 2); normals must be of unit length");
}

TEST_CASE("relaxation: a flux that is no number is refused by its photon's number") {
    for (const double bad : {not_a_number, infinity}) {
        auto photons = random_floor(100, 101);
        photons[42].flux = bad;
        const auto start = photons;
        const std::string value = std::isnan(bad) ? "nan" : "inf";
        const std::string expected = ": photon 42 has a flux of " + value + "; fluxes must be finite";
        CHECK_THROWS_WITH(run(photons, {}), ("nephroid::relax" + expected).c_str());
        CHECK_THROWS_WITH(run(photons, {.flux_diffusion = FluxDiffusion::conserving}),
                          ("nephroid::relax" + expected).c_str());
        CHECK_THROWS_WITH((void)detect_features(photons, access_to<Stored>(), {}),
                          ("nephroid::detect_features" + expected).c_str());
        CHECK(same_positions(photons, start));
    }
}

// Powers of two scale floating-point numbers without rounding. 150 squares of 2^60 add up to more than float's 2^128:
// features would hold photons where they are.
TEST_CASE("relaxation: the unit of length may be any in which squared distances add up") {
    const auto start = random_floor<glm::vec3>(500, 102);
    for (const auto& options : {RelaxationOptions{}, RelaxationOptions::keeping_density()}) {
        auto expected = start;
        run(expected, options);
        CHECK_FALSE(same_positions(expected, start));
        for (const int exponent : {-40, 56}) {
            auto photons = start;
            for (auto& photon : photons)
                photon.position *= std::ldexp(1.0f, exponent);
            run(photons, options);
            for (auto& photon : photons)
                photon.position *= std::ldexp(1.0f, -exponent);
            CHECK(same_positions(photons, expected));
        }
        auto huge = start;
        for (auto& photon : huge)
            photon.position *= std::ldexp(1.0f, 60);
        CHECK_THROWS_WITH_AS(run(huge, options), doctest::Contains("use a larger unit of length"),
                             std::invalid_argument);
    }
}

TEST_CASE("relaxation: photons too far apart for squared distances are refused by their number") {
    auto photons = random_floor<glm::vec3>(100, 102);
    photons[9].position = {2e19f, 0, 0};
    const auto start = photons;
    std::string message;
    try {
        run(photons, {});
    } catch (const std::invalid_argument& error) {
        message = error.what();
    }
    CHECK(message.starts_with("nephroid::relax: photon 9 lies at ("));
    CHECK(message.ends_with(", so far from the others that squared distances overflow; use a larger unit of length"));
    CHECK(same_positions(photons, start));
}

TEST_CASE("relaxation: without an executor everything runs on the calling thread") {
    auto photons = random_floor(200, 103), same = photons;
    run(photons, {.iterations = 3});
    relax(same, access_to<Stored>(), {.iterations = 3});
    CHECK(same_positions(photons, same));
}

// Six push a photon and a seventh sets the radius: among fewer there is no disc, and they would drive each other away.
TEST_CASE("relaxation: photons with fewer than seven others on their surface stay where they are") {
    for (const int count : {2, 3, 7}) {
        auto photons = random_floor(count, 104);
        const auto start = photons;
        run(photons, {.iterations = 50, .rho = 0});
        CHECK(same_positions(photons, start));
    }
    auto eight = random_floor(8, 104);
    const auto start = eight;
    run(eight, {.iterations = 5});
    CHECK_FALSE(same_positions(eight, start));
}

TEST_CASE("relaxation: a projection that clamps keeps photons on a bounded floor") {
    auto photons = random_floor(2000, 105), free = photons;
    const auto on_floor = [](std::size_t, const glm::dvec3& p) {
        return glm::dvec3(std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0), 0);
    };
    const auto beside = [&](const std::vector<Stored>& map) {
        return std::count_if(map.begin(), map.end(),
                             [&](const Stored& p) { return length(p.position - on_floor(0, p.position)) > 0; });
    };
    relax(photons, access_to<Stored>(), {}, SerialExecutor{}, on_floor);
    run(free, {});
    CHECK(beside(photons) == 0);
    CHECK(beside(free) > 0);
    CHECK(nearest_distance(photons) > 1.25);
}

// A photon on a unit sphere that moves by d turns its normal by d: all stay radial, to rounding.
TEST_CASE("relaxation: a projection may turn normals with the surface") {
    Draws draw(106);
    std::vector<Stored> photons;
    for (int i = 0; i < 500; ++i) {
        const auto n = narrow<glm::dvec3>(draw.direction());
        photons.push_back({i, n, n, 1});
    }
    auto still = photons;
    const auto on_sphere = [](std::size_t, const glm::dvec3& p) {
        const glm::dvec3 n = (1 / length(p)) * p;
        return SurfacePoint<glm::dvec3>{n, n};
    };
    const auto worst = [](const std::vector<Stored>& map) {
        double angle = 0;
        for (const Stored& p : map)
            angle = std::max(angle, length(p.position - p.normal));
        return angle;
    };
    relax(photons, access_to<Stored>(), {.iterations = 30}, SerialExecutor{}, on_sphere);
    CHECK(worst(photons) < 1e-13); // 30 times to the tree's origin and back
    relax(still, access_to<Stored>(), {.iterations = 30}, SerialExecutor{},
          [&](std::size_t i, const glm::dvec3& p) { return on_sphere(i, p).position; });
    CHECK(worst(still) > 0.05); // the spacing is 0.16
    std::vector<Stored> parallel, again;
    for (const Stored& p : still)
        parallel.push_back({p.number, p.position, p.position, 1});
    again = parallel;
    ThreadExecutor threads(3);
    relax(parallel, access_to<Stored>(), {.iterations = 5}, threads, on_sphere);
    relax(again, access_to<Stored>(), {.iterations = 5}, SerialExecutor{}, on_sphere);
    CHECK(same_positions(parallel, again));
    const auto none = [](std::size_t, const glm::dvec3& p) { return SurfacePoint<glm::dvec3>{p, {0, 0, 0}}; };
    CHECK_THROWS_AS(relax(again, access_to<Stored>(), {}, SerialExecutor{}, none), std::invalid_argument);
}

TEST_CASE("relaxation: an executor that leaves a task out is refused and the photons stay as they were") {
    auto photons = random_floor(3000, 104);
    const auto before = photons;
    const auto leaves_out = [](std::size_t count, const auto& task) {
        for (std::size_t i = 0; i + 1 < count; ++i)
            task(i);
    };
    CHECK_THROWS_AS(relax(photons, access_to<Stored>(), {.iterations = 2}, leaves_out), std::invalid_argument);
    CHECK(same_positions(photons, before));
}

TEST_CASE_TEMPLATE("relaxation: any number of photons in one place part", T, float, double) {
    using V = glm::vec<3, T>;
    for (const std::size_t together : {36u, 60u, 200u})
        for (const bool constrain : {true, false}) {
            auto photons = random_floor<V>(600, 107);
            for (std::size_t i = 0; i < together; ++i)
                photons[i].position = photons[0].position;
            run(photons, {.constrain = constrain});
            CHECK(all_photons_finite(photons));
            std::size_t still = 0;
            for (std::size_t i = 0; i < together; ++i)
                still += distances(photons, i).front().first == 0;
            CHECK(still <= together / 50); // where floats end two of many may meet again
        }
}

// The spacing is 1/√20 = 0.22. Twice as dense the upper sheet would push the lower one apart. Photons move in the
// order of their numbers, as those of two sides of a wall above.
TEST_CASE("relaxation: parallel sheets with one normal that lie closer than a spacing do not feel each other") {
    for (const double height : {0.001, 0.01, 0.1, 0.2}) {
        auto lower = random_floor(20, 108);
        auto upper = random_floor(40, 109);
        for (Stored& photon : upper)
            photon.position.z = height;
        auto both = lower;
        both.insert(both.end(), upper.begin(), upper.end());
        run(both, {.iterations = 10, .constrain = false});
        run(lower, {.iterations = 10, .constrain = false});
        CHECK(farthest_apart(lower, both) < 1e-9);
    }
}

TEST_CASE("relaxation: a map that keeps its density reports the pilot and the neighbours to estimate with") {
    auto photons = random_floor(8000, 110), halton = photons;
    auto report = run(photons, RelaxationOptions::keeping_density());
    CHECK_FALSE(report.stratified);
    CHECK(report.pilot_neighbours >= 300); // nothing to see: the more the better
    CHECK(report.estimate_neighbours == std::clamp(report.pilot_neighbours / 16, 20u, 40u));
    for (std::size_t i = 0; i < halton.size(); ++i) { // a lattice: (i/n, i times the golden ratio)
        const double y = double(i) * 0.6180339887498949;
        halton[i].position = {(double(i) + 0.5) / 8000, y - std::floor(y), 0};
    }
    report = run(halton, RelaxationOptions::keeping_density());
    CHECK(report.stratified);
    CHECK(report.pilot_neighbours == 150);
    CHECK(report.estimate_neighbours == 20);
    CHECK(run(photons, {}).pilot_neighbours == 0);
    auto few = random_floor(100, 111);
    report = run(few, RelaxationOptions::keeping_density());
    CHECK(report.pilot_unjudged);
    CHECK(report.pilot_neighbours == 150);
}

} // namespace nephroid::tests::relax_test
