// SPDX-License-Identifier: MIT
// The path traced reference against answers that do not come from tracing paths: sums along the light's own way, and
// closed forms under a uniform sky.
#include "quality/reference/compare.hpp" // before the library's `dot`, which its own would not be looked for behind

#include "common/path_tracer/path_tracer.hpp"
#include "nephroid/quality/reference/ball.hpp"
#include "nephroid/quality/reference/fresnel.hpp"
#include "nephroid/quality/reference/quadrature.hpp"
#include "nephroid/quality/reference/ring.hpp"

#include "nephroid/sequence/halton.hpp"
#include "nephroid/transport/walk.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::examples::path_tracer_test {

namespace exact = nephroid::reference;

namespace {

using Case = BuiltinCase<double, double>;
using Materials = std::vector<Material<double>>;
using Vec = Vec3<double>;

[[nodiscard]] exact::Film film_of(const FilmRectangle& film, std::size_t size) {
    return {film.x_min, film.x_max, film.y_min, film.y_max, int(size), int(size)};
}

/// Points that fill the unit cube of D dimensions evenly: a mean over n of them is off by about 1/n, for functions that
/// do not jump. Source: Roberts 2018, the root of x^(D + 1) = x + 1.
template <std::size_t D>
class Lattice {
public:
    Lattice() {
        double root = 2;
        for (int step = 0; step < 60; ++step)
            root = std::pow(1 + root, 1 / double(D + 1));
        for (std::size_t d = 0; d < D; ++d)
            step_[d] = std::pow(root, -double(d + 1));
    }

    [[nodiscard]] std::array<double, D> operator[](std::size_t i) const {
        std::array<double, D> point{};
        for (std::size_t d = 0; d < D; ++d) {
            const double x = 0.5 + double(i) * step_[d];
            point[d] = x - std::floor(x);
        }
        return point;
    }

private:
    std::array<double, D> step_{};
};

/// The light of a disk that faces the origin, reflected by the half cylinder of nephroid/quality/reference/ring.hpp,
/// taken along its own way: from a point of the disk to a column of the mirror, and from there on, seen from above,
/// along chords of the circle or out where there is no mirror. What the column reflects lands on a line on the floor,
/// and its density along the line is known, as the height at which light meets the column says how far it gets.
class RingSums {
public:
    RingSums(const Vec& centre, double radius, double radiance, const exact::Film& film)
        : centre_(centre), radius_(radius), radiance_(radiance), film_(film),
          image_(std::size_t(film.width) * std::size_t(film.height)), normal_(normalize(-centre)),
          across_(frame_about(normal_)) {}

    /// @param rays  points of the lattice over the disk and the columns
    /// @param once  leave out what would be reflected a second time
    [[nodiscard]] exact::Image irradiance(std::size_t rays, bool once = false) {
        once_ = once;
        const Lattice<3> lattice;
        for (std::size_t i = 0; i < rays; ++i) {
            const auto [a, b, c] = lattice[i];
            const DiskPoint<double> disk = concentric_disk(a, b);
            const Vec from = centre_ + radius_ * (disk.x * across_.u + disk.y * across_.v);
            add_column(from, pi<double> * (c - 0.5), pi<double> * pi<double> * square(radius_) / double(rays));
        }
        return image_;
    }

private:
    struct Plan {
        double x, y;
    };

    /// @param angle    of the column, seen from the axis
    /// @param measure  of light's area and angle that the column stands for
    void add_column(const Vec& from, double angle, double measure) {
        from_ = from;
        const Plan normal{std::cos(angle), std::sin(angle)};
        Plan at = normal, direction{at.x - from.x, at.y - from.y};
        distance_ = std::hypot(direction.x, direction.y);
        direction = {direction.x / distance_, direction.y / distance_};
        strength_ = radiance_ * measure * distance_ * (direction.x * normal.x + direction.y * normal.y);
        if (!(strength_ > 0))
            return; // the outer side
        column_ = at;
        const double height = 0.5, reach = height * distance_ / (from.z - height);
        for (double flown = 0; flown < reach;) {
            const double across = direction.x * at.x + direction.y * at.y;
            direction = {direction.x - 2 * across * at.x, direction.y - 2 * across * at.y};
            const Plan next{at.x + 2 * across * direction.x, at.y + 2 * across * direction.y};
            const double chord = next.x >= 0 ? 2 * across : HUGE_VAL; // or out through the open side
            add_segment(at, direction, flown, (std::min)(reach, flown + chord));
            flown += once_ ? HUGE_VAL : chord;
            at = next;
        }
    }

    /// What lands per length at a distance from the column: the flux on the mirror per height, where light comes from
    /// that lands there, times how fast that height changes.
    [[nodiscard]] double density(double distance) const {
        const double sum = distance_ + distance, height = from_.z * distance / sum;
        const Vec flight(column_.x - from_.x, column_.y - from_.y, height - from_.z);
        const double cosine = dot(flight, normal_), length_2 = dot(flight, flight);
        return cosine > 0 ? strength_ * cosine / (length_2 * length_2) * from_.z * distance_ / (sum * sum) : 0;
    }

    /// @param from,to  distances from the column along the light's way, `from` being at `start`
    void add_segment(Plan start, Plan direction, double from, double to) {
        if (misses_film(start, direction, to - from))
            return;
        std::vector<double> cuts{0, to - from};
        const auto cut = [&](double at, double along, double line) {
            if (const double s = (line - at) / along; s > 0 && s < to - from)
                cuts.push_back(s);
        };
        for (int i = 0; i <= film_.width; ++i)
            cut(start.x, direction.x, film_.x(i));
        for (int j = 0; j <= film_.height; ++j)
            cut(start.y, direction.y, film_.y(j));
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            const double middle = 0.5 * (cuts[i] + cuts[i + 1]), half = 0.5 * (cuts[i + 1] - cuts[i]);
            const double node = half / std::sqrt(3.0); // Gauss-Legendre: the density is smooth
            const double flux = half * (density(from + middle - node) + density(from + middle + node));
            exact::add_flux(image_, film_, start.x + middle * direction.x, start.y + middle * direction.y, flux);
        }
    }

    [[nodiscard]] bool misses_film(Plan start, Plan direction, double length) const {
        const Plan end{start.x + length * direction.x, start.y + length * direction.y};
        return (std::max)(start.x, end.x) < film_.x_min || (std::min)(start.x, end.x) > film_.x_max ||
               (std::max)(start.y, end.y) < film_.y_min || (std::min)(start.y, end.y) > film_.y_max;
    }

    Vec centre_;
    double radius_, radiance_;
    exact::Film film_;
    exact::Image image_;
    Vec normal_;
    Frame<Vec> across_;
    Vec from_{0};
    Plan column_{};
    double distance_ = 0, strength_ = 0;
    bool once_ = false;
};

/// The light of a sphere that sends 16 W/sr, refracted twice by the ball of nephroid/quality/reference/ball.hpp.
/// Parallel rays of the sphere's light make a disk: they are a lattice over directions and disks.
[[nodiscard]] exact::Image ball_sums(double radius, const exact::Film& film, std::size_t rays) {
    exact::Image image(std::size_t(film.width) * std::size_t(film.height));
    const double sine = (1 + radius) / 4, height = 1 - std::sqrt(1 - sine * sine); // all that may meet the ball
    const Vec down(0, 0, -1), centre(0, 0, 1.25);
    const Lattice<4> lattice;
    for (std::size_t i = 0; i < rays; ++i) {
        const auto [a, b, c, d] = lattice[i];
        Vec along = cap_direction(down, frame_about(down), height, concentric_disk(a, b));
        const DiskPoint<double> disk = concentric_disk(c, d);
        const Frame<Vec> across = frame_about(along);
        Vec at = Vec(0, 0, 5.25) + radius * (disk.x * across.u + disk.y * across.v);
        bool meets = true;
        for (const double eta : {1 / 1.5, 1.5}) {
            const Vec from_centre = at - centre;
            const double middle = dot(from_centre, along);
            const double discriminant = square(middle) - dot(from_centre, from_centre) + 1;
            meets = meets && discriminant > 0;
            if (!meets)
                break;
            at = at + (-middle + (eta < 1 ? -1 : 1) * std::sqrt(discriminant)) * along;
            // Snell: the part of the direction along the surface is multiplied by n1/n2.
            const Vec normal = at - centre;
            const Vec tangential = eta * (along - dot(along, normal) * normal);
            along = tangential + (eta < 1 ? -1 : 1) * std::sqrt(1 - dot(tangential, tangential)) * normal;
        }
        if (meets && along.z < 0)
            exact::add_flux(image, film, at.x - at.z / along.z * along.x, at.y - at.z / along.z * along.y,
                            16 * 2 * pi<double> * height / double(rays));
    }
    return image;
}

/// Disagreement of two pictures.
struct Agreement {
    double chi2 = 0, pixels = 0;         ///< sum of squares of differences in standard errors, over how many pixels
    double all_pixels = 0;               ///< that there are
    double difference = 0, variance = 0; ///< of the sum of all pixels
    [[nodiscard]] double z() const { return difference / std::sqrt(variance); }
};

/// Only pixels with a relative standard error of less than a tenth count: those with fewer hits are far from normal.
[[nodiscard]] Agreement compare(const PathTracedReference& traced, const exact::Image& truth) {
    Agreement agreement;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = traced.mean[i] - truth[i], error = traced.standard_error[i];
        agreement.all_pixels += 1;
        agreement.difference += difference;
        agreement.variance += square(error);
        if (error > 0 && error < 0.1 * traced.mean[i]) {
            agreement.chi2 += square(difference / error);
            agreement.pixels += 1;
        }
    }
    return agreement;
}

/// With p passes a pixel's difference over its standard error has Student's t distribution of p - 1 degrees, so its
/// square the mean (p - 1)/(p - 3) and about the variance 2 of chi squared, 2.6 for 32 passes and more. Four standard
/// deviations of the sum, and of the z of the whole, are missed once in ten thousand seeds.
void check_agreement(const Agreement& agreement, double passes) {
    const double expected = agreement.pixels * (passes - 1) / (passes - 3);
    CAPTURE(agreement.pixels);
    CAPTURE(agreement.chi2);
    CHECK(2 * agreement.pixels > agreement.all_pixels);
    CHECK(std::abs(agreement.chi2 - expected) < 4 * std::sqrt(2.6 * agreement.pixels));
    CHECK(std::abs(agreement.z()) < 4);
}

constexpr double sky_radius = 1e5;

/// A disk so large that it is a sky of radiance 1: what it leaves dark at the horizon is 1e-8 of the floor's
/// irradiance.
[[nodiscard]] Case under_sky(examples::Scene<double, double> scene) {
    const Vec up(0, 0, 10), down(0, 0, -1);
    const DiskLight<Vec, double> light({.centre = up, .normal = down, .radius = sky_radius, .radiance = 1});
    return {std::move(scene),
            CaseLight<double, double>({light}),
            {-0.5, 0.5, -0.5, 0.5},
            false,
            {Emitter<double, double>::disk(up, down, sky_radius, 1)}};
}

[[nodiscard]] std::string message_of(const std::function<void()>& f) {
    try {
        f();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

[[nodiscard]] PathTraceOptions few(std::uint64_t samples) {
    PathTraceOptions options;
    options.samples = samples;
    options.pilot = 2;
    options.rehearsals = 24;

    return options;
}

/// A part of the ring's film against the sums. Measured against more rays these are good to 0.3% of a pixel at the
/// cusp, in the worst pixels elsewhere to some percent, less than the standard errors.
void check_ring(const FilmRectangle& film, bool once, unsigned passes, unsigned samples_per_pass) {
    Case ring = builtin_case<double, double>("ring-disk", false).value();
    const Emitter<double, double>& disk = ring.emitters.front();
    const std::size_t size = 6;
    ring.film = film;
    PathTraceOptions options = few(passes * samples_per_pass);
    options.samples_per_pass = samples_per_pass;
    options.specular_events = once ? 1 : 1u << 16;
    SerialExecutor serial;
    const PathTracedReference traced = path_trace_reference(ring, size, size, options, serial);
    RingSums sums(disk.centre, disk.radius, disk.radiance, film_of(film, size));
    check_agreement(compare(traced, sums.irradiance(200'000, once)), double(passes));
}

} // namespace

// Worst pixel: the lattice's 5e4 points are good to about 1/500 of a pixel that gets a hundredth of the light.
TEST_CASE("path tracer: the sums that it is compared with become the exact ring as the disk becomes the sun") {
    const exact::Film film{-0.1, 2.1, -1.1, 1.1, 11, 11};
    // 1e5 away and of radius 1 the disk's rays differ by 1e-5; irradiance 1 at the origin as the sun's.
    const double elevation = 35 * pi<double> / 180, distance = 1e5;
    const Vec centre(-distance * std::cos(elevation), 0, distance * std::sin(elevation));
    for (const bool once : {false, true}) {
        RingSums sums(centre, 1, square(distance) / (pi<double> * std::sin(elevation)), film);
        const exact::Image image = sums.irradiance(50'000, once);
        const exact::Image truth = exact::ring({once ? exact::Reflections::one : exact::Reflections::any}, film);
        CHECK(exact::worst_difference(image, truth, 0.1) < 0.01);
        CHECK(exact::mean(image) == doctest::Approx(exact::mean(truth)).epsilon(1e-4));
    }
}

TEST_CASE("path tracer: the sums that it is compared with become the exact ball as the sphere becomes a point") {
    const exact::Film film{-0.5, 0.5, -0.5, 0.5, 8, 8};
    const exact::Image image = ball_sums(0, film, 400'000);
    const exact::Image truth = exact::ball({exact::BallLight::point, false}, film);
    CHECK(exact::worst_difference(image, truth, 0.1) < 0.01);
    CHECK(exact::mean(image) == doctest::Approx(exact::mean(truth)).epsilon(1e-3));
}

TEST_CASE("path tracer: the ring under a disk agrees with sums along the light's own way at the cusp") {
    check_ring({0.3, 0.42, -0.05, 0.07}, false, 48, 16);
}

TEST_CASE("path tracer: the ring under a disk agrees with sums along the light's own way with small passes") {
    check_ring({0.3, 0.42, -0.05, 0.07}, false, 160, 5);
}

TEST_CASE("path tracer: the ring under a disk agrees with sums along the light's own way at the mirror") {
    check_ring({0.78, 0.9, 0.3, 0.42}, false, 48, 16); // where light arrives that was reflected several times
}

TEST_CASE("path tracer: the ring under a disk agrees with sums along the light's own way for one reflection") {
    check_ring({0.78, 0.9, 0.3, 0.42}, true, 48, 20);
}

TEST_CASE("path tracer: the ring under a disk agrees with sums along the light's own way in the half shade") {
    check_ring({0.0, 0.12, 0.3, 0.42}, false, 48, 16);
}

TEST_CASE("path tracer: the ball under a sphere of light agrees with sums along the light's own way") {
    const double radius = 0.6;
    Case ball = builtin_case<double, double>("ball-point", false).value();
    const Vec centre(0, 0, 5.25);
    const double radiance = 16 / (pi<double> * square(radius));     // 16 W/sr
    ball.light = CaseLight<double, double>({DiskLight<Vec, double>( // paths do not ask it
        {.centre = centre, .normal = {0, 0, -1}, .radius = radius, .radiance = radiance})});
    ball.emitters = {Emitter<double, double>::sphere(centre, radius, radiance)};
    ball.film = {-0.3, 0.3, -0.3, 0.3};
    PathTraceOptions options = few(32 * 40);
    options.samples_per_pass = 40;
    SerialExecutor serial;
    const PathTracedReference traced = path_trace_reference(ball, 6, 6, options, serial);
    check_agreement(compare(traced, ball_sums(radius, film_of(ball.film, 6), 200'000)), 32);
}

// Radiance is the same along a ray before and behind the ball, so its irradiance is that of a ball that glows:
// π R² h / d³ on the floor, h below its centre and d away from it. That is a pixel's integral in closed form.
TEST_CASE("path tracer: under a uniform sky a glass ball is as bright as the sky") {
    const Vec centre(0, 0, 1.25);
    const double h = centre.z;
    examples::Scene<double, double> scene(
        {{Floor<double>(0), 0}, {Sphere<double>(centre, 1), 1}},
        Materials{Material<double>::diffuse(1), Material<double>::dielectric(1.5, false, Follow::refraction)});
    const Case ball = under_sky(std::move(scene));
    const std::size_t size = 4;
    const exact::Film film = film_of(ball.film, size);
    exact::Image truth;
    const auto corner = [h](double x, double y) { return std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h))); };
    for (int j = 0; j < film.height; ++j)
        for (int i = 0; i < film.width; ++i)
            truth.push_back(pi<double> *
                            (corner(film.x(i + 1), film.y(j + 1)) - corner(film.x(i), film.y(j + 1)) -
                             corner(film.x(i + 1), film.y(j)) + corner(film.x(i), film.y(j))) /
                            (film.pixel_width() * film.pixel_height()));
    SerialExecutor serial;
    check_agreement(compare(path_trace_reference(ball, size, size, few(512), serial), truth), 32);
}

// Below flat water the sky is squeezed into the critical cone, n² times as bright: π all in all, less what the
// surface reflects and the water absorbs.
TEST_CASE("path tracer: flat water passes on the light of a uniform sky") {
    const double index = 1.33, depth = 0.5;
    struct Kind {
        bool fresnel;
        Follow follow;
        double absorption;
    };
    for (const Kind kind : {Kind{false, Follow::refraction, 0}, Kind{true, Follow::refraction, 0},
                            Kind{true, Follow::both, 0}, Kind{true, Follow::both, 1.5}}) {
        Material<double> water = Material<double>::dielectric(index, kind.fresnel, kind.follow);
        water.absorption = kind.absorption;
        examples::Scene<double, double> scene({{Floor<double>(0), 0}, {SineWave<double>({.height = depth}), 1}},
                                              Materials{Material<double>::diffuse(1), water});
        const double irradiance = exact::detail::integrate_panels<16>(
            [&](double angle) { // from the zenith, above the water
                const double sine = std::sin(angle), cosine = std::cos(angle), below = sine / index;
                const double passed = kind.fresnel ? exact::detail::transmittance(sine, index) : 1;
                return 2 * pi<double> * sine * cosine * passed *
                       std::exp(-kind.absorption * depth / std::sqrt(1 - below * below));
            },
            0, 0.5 * pi<double>, 0.05);
        SerialExecutor serial;
        const PathTracedReference traced = path_trace_reference(under_sky(std::move(scene)), 2, 2, few(512), serial);
        CAPTURE(irradiance);
        check_agreement(compare(traced, exact::Image(4, irradiance)), 32);
    }
}

TEST_CASE("path tracer: the picture is the same for any number of threads and another one for another seed") {
    const Case ring = builtin_case<double, double>("ring-disk", false).value();
    PathTraceOptions options = few(32);
    options.pilot = 1;
    options.rehearsals = 2;
    SerialExecutor serial;
    const PathTracedReference alone = path_trace_reference(ring, 6, 5, options, serial);
    for (const unsigned count : {2u, 5u}) {
        ThreadExecutor threads(count);
        const PathTracedReference shared = path_trace_reference(ring, 6, 5, options, threads);
        CHECK(shared.mean == alone.mean);
        CHECK(shared.standard_error == alone.standard_error);
    }
    options.seed = 1;
    CHECK(path_trace_reference(ring, 6, 5, options, serial).mean != alone.mean);
}

TEST_CASE("path tracer: progress is told after each pass and may end it") {
    const Case ring = builtin_case<double, double>("ring-disk", false).value();
    PathTraceOptions options = few(1000);
    SerialExecutor serial;
    std::vector<std::uint64_t> told;
    const PathTracedReference stopped = path_trace_reference(ring, 4, 4, options, serial, [&](const auto& so_far) {
        told.push_back(so_far.samples);
        CHECK(so_far.mean.size() == 16);
        CHECK(std::isinf(so_far.standard_error[0]) == (told.size() == 1));
        return told.size() < 3;
    });
    CHECK(told == std::vector<std::uint64_t>{16, 32, 48});
    CHECK(stopped.samples == 48);
    options.seconds = 0; // two passes are the least that has a standard error
    CHECK(path_trace_reference(ring, 4, 4, options, serial).samples == 32);
    options.samples = 1;
    CHECK(path_trace_reference(ring, 4, 4, options, serial).samples == 16);
}

TEST_CASE("path tracer: what it cannot do is refused by name") {
    const Case ring = builtin_case<double, double>("ring-disk", false).value();
    const auto refusal = [](const Case& builtin, std::size_t width, const PathTraceOptions& options) {
        SerialExecutor serial;
        return message_of([&] { static_cast<void>(path_trace_reference(builtin, width, 4, options, serial)); });
    };
    for (const char* name : {"wave-focused", "ring", "ball-point"})
        CHECK(refusal(builtin_case<double, double>(name, false).value(), 4, few(1)).find("no area") !=
              std::string::npos);
    CHECK(refusal(ring, 0, few(1)).find("0 x 4") != std::string::npos);
    CHECK(refusal(ring, 4, few(0)).find("0 samples") != std::string::npos);
    PathTraceOptions options = few(1);
    options.samples_per_pass = 3;
    CHECK(refusal(ring, 4, options).find("3 samples") != std::string::npos);
    options = few(1);
    options.seconds = std::nan("");
    CHECK(refusal(ring, 4, options).find("seconds") != std::string::npos);
    options = few(1);
    options.pilot = 0;
    CHECK(refusal(ring, 4, options).find("pilot") != std::string::npos);
    Case empty = ring;
    empty.film.x_max = empty.film.x_min;
    CHECK(refusal(empty, 4, few(1)).find("film") != std::string::npos);

    // Glass in glass is refused, glass beside glass is not, nor is a mirror in glass.
    const auto with_second = [&](const Vec3<double>& centre, const Material<double>& second) {
        Case two = ring;
        two.scene = {{{Floor<double>(0), 0}, {Sphere<double>({0, 0, 2}, 1), 1}, {Sphere<double>(centre, 0.5), 2}},
                     {Material<double>::diffuse(1), Material<double>::dielectric(1.5), second}};
        return refusal(two, 4, few(1));
    };
    const auto water = Material<double>::dielectric(1.33);
    CHECK(with_second({0, 0, 2}, water).find("parts 1 and 2 overlap, and both are of glass") != std::string::npos);
    CHECK(with_second({0.9, 0, 2}, water).find("both are of glass") != std::string::npos);
    CHECK(with_second({3, 0, 2}, water) == "accepted");
    CHECK(with_second({0, 0, 2}, Material<double>::mirror(1)) == "accepted");
}

// As photons carry it: the library's light, walked through the same scene. 200,000 Halton photons are good to a
// thousandth.
TEST_CASE("path tracer: the disk's photons bring the mirror all the light that paths find") {
    const Case ring = builtin_case<double, double>("ring-disk", false).value();
    const Emitter<double, double>& disk = ring.emitters.front();
    const exact::Film all{-3, 2, -3, 3, 10, 12};
    const exact::Image sums = RingSums(disk.centre, disk.radius, disk.radiance, all).irradiance(100'000);
    const double landed = exact::mean(sums) * 30;
    const HaltonSequence halton;
    Statistics account;
    double flux = 0, reached = 0;
    const std::size_t photons = 200'000;
    for (std::size_t i = 0; i < photons; ++i) {
        Sampler<HaltonSequence> sampler(halton, i);
        const auto photon = ring.light.emit(sampler, Spread<double>{double(photons), 1});
        if (const auto deposit = walk(ring.scene, photon, sampler, WalkLimits{1u << 16, 1u << 16}, account)) {
            flux += deposit->flux;
            reached = (std::max)({reached, std::abs(deposit->position.x), std::abs(deposit->position.y)});
        }
    }
    CHECK(flux == doctest::Approx(landed).epsilon(1e-3));
    CHECK(reached < 2); // nothing lands beside the film of the sums
}

} // namespace nephroid::examples::path_tracer_test
