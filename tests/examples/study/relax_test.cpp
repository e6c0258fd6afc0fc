// SPDX-License-Identifier: MIT
// `study relax` from within: its options, patterns, edges, spectra, and what relaxing does to them.
#include "common/image/png.hpp"
#include "common/image/read_png.hpp"
#include "common/study/relax/command.hpp"
#include "common/study/relax/pattern.hpp"
#include "common/study/relax/pictures.hpp"
#include "common/study/relax/tables.hpp"
#include "support/gltf_writer.hpp"
#include "support/is_sanitized.hpp"
#include "support/temporary_folder.hpp"

#include <CLI/CLI.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

namespace nephroid::examples::relax_test {

using namespace nephroid::examples::study::relax;
using namespace nephroid::tests;

namespace {

[[nodiscard]] Options read(std::initializer_list<const char*> arguments) {
    CLI::App app;
    const Command command(app);
    std::vector<const char*> argv{"relax"};
    argv.insert(argv.end(), arguments);
    REQUIRE(parse(app, static_cast<int>(argv.size()), argv.data()));
    return command.options().front();
}

[[nodiscard]] Options small(const std::string& subject) {
    Options options;
    options.subject = subject;
    options.photons = 4000;
    options.width = options.height = 48;
    options.height_given = true;
    options.neighbours = {20, 50};
    options.sweep = {20, 50};
    return options;
}

[[nodiscard]] bool in_unit_square(const StoredPhoton& photon) {
    return photon.position.x >= 0 && photon.position.x < 1 && photon.position.y >= 0 && photon.position.y < 1;
}

[[nodiscard]] double total_flux(const std::vector<StoredPhoton>& photons) {
    double sum = 0;
    for (const StoredPhoton& photon : photons)
        sum += static_cast<double>(photon.flux.x);
    return sum;
}

} // namespace

TEST_CASE("relaxation: options are read, lists of neighbours come in order and once") {
    const auto options = read({"ring",
                               "--photons",
                               "6e4",
                               "--iterations",
                               "50",
                               "--neighbours",
                               "250,20,50,20",
                               "--over-relaxation",
                               "1",
                               "1",
                               "--constrain",
                               "off",
                               "--features",
                               "0",
                               "0.5",
                               "--rho",
                               "0.2",
                               "--flux-diffusion",
                               "conserving",
                               "--size",
                               "64x48"});
    CHECK(options.photons == 60'000);
    CHECK(options.relaxation.iterations == 50);
    CHECK(options.relaxation.over_relaxation == 1);
    CHECK(options.relaxation.final_relaxation == 1);
    CHECK_FALSE(options.relaxation.constrain);
    CHECK(options.relaxation.beta == 0.5);
    CHECK(options.relaxation.rho == 0.2);
    CHECK(options.relaxation.flux_diffusion == FluxDiffusion::conserving);
    CHECK(options.neighbours == std::vector<std::size_t>{20, 50, 250});
    CHECK(options.height == 48);
}

TEST_CASE("relaxation: a map may keep its density, be looked at by another kernel and by several eyes per pixel") {
    const auto options = read({"ring", "--keep-density", "on", "--rho", "0.2", "--iterations", "7", "--kernel",
                               "biweight", "--samples", "4", "--flux-diffusion", "conserving"});
    CHECK(options.relaxation.pilot_neighbours == nephroid::RelaxationOptions::chosen_by_map);
    CHECK(options.relaxation.neighbours == 12);
    CHECK(options.relaxation.over_relaxation == 1);
    CHECK(options.relaxation.rho == 0.2);
    CHECK(options.relaxation.iterations == 7);
    CHECK(options.relaxation.flux_diffusion == FluxDiffusion::conserving);
    CHECK(options.kernel == LookKernel::biweight);
    CHECK(options.samples == 4);
    const auto paper = read({"ring"});
    CHECK(paper.relaxation.pilot_neighbours == 0);
    CHECK(paper.relaxation.neighbours == 6);
    CHECK(paper.kernel == LookKernel::epanechnikov);
    CHECK_FALSE(paper.timing);
    CHECK(read({"--timing", "--photons", "1e4"}).timing); // of no subject
}

// `chosen` asks for no k of its own: the unrelaxed map has its best alone, the relaxed one what `relax` reports.
TEST_CASE("relaxation: k may be chosen by the map") {
    CHECK(read({"sines", "--neighbours", "chosen"}).neighbours.empty());
    CHECK_FALSE(read({"sines"}).neighbours.empty());
    Options options = small("soft-disc");
    options.neighbours.clear();
    options.sequence = SequenceKind::random;
    options.relaxation = RelaxationOptions::keeping_density();
    options.relaxation.iterations = 2;
    ThreadExecutor threads(1);
    const Subject subject = make_subject(options, threads);
    const BeforeAndAfter measured = before_and_after(subject, options, threads);
    CHECK(measured.before.looks.empty());
    REQUIRE(measured.after.looks.size() == 1);
    CHECK(measured.after.looks[0].neighbours == measured.relaxation.estimate_neighbours);
    const auto row = verdict_row(options, measured);
    REQUIRE(row.has_value());
    CHECK((*row)[3] == std::to_string(measured.relaxation.estimate_neighbours));
}

// 20 of 4000 photons lie in a disk of radius 0.035, of which a border hides up to a half. As the border is 4 long, a
// sixth of the floor lies so near to it.
TEST_CASE("relaxation: on a floor that ends photons stay and the picture is bright up to its border") {
    Options options = small("l-shape");
    options.sequence = SequenceKind::random;
    ThreadExecutor threads(1);
    Subject subject = make_subject(options, threads);
    CHECK(subject.photons.size() == 4000);
    const BeforeAndAfter measured = before_and_after(subject, options, threads);
    for (const StoredPhoton& photon : measured.relaxed)
        CHECK(subject.on_surface(photon.position));
    const double covered = measured.after.looks[0].errors->relative;
    CHECK(covered < 0.7 * measured.before.looks[0].errors->relative);
    subject.on_surface = nullptr;
    CHECK(covered < 0.8 * before_and_after(subject, options, threads).after.looks[0].errors->relative);
}

TEST_CASE("relaxation: what cannot be done is refused with a line that names the option") {
    const auto message = [](std::initializer_list<const char*> arguments) -> std::string {
        try {
            static_cast<void>(read(arguments));
        } catch (const UsageError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(message({"ring", "--photons", "0"}).find("--photons") != std::string::npos);
    CHECK(message({"ring", "--neighbours", "10,1"}).find("--neighbours") != std::string::npos);
    CHECK(message({"ring", "--neighbours", ""}).find("--neighbours") != std::string::npos);
    CHECK(message({"ring", "--sweep", "20,"}).find("--sweep") != std::string::npos);
    CHECK(message({"ring", "--features", "0.5", "0.2"}).find("alpha") != std::string::npos);
    CHECK(message({"ring", "--over-relaxation", "0", "1"}).find("over_relaxation") != std::string::npos);
    CHECK(message({"ring", "--rho", "nan"}).find("rho") != std::string::npos);
    CHECK(message({"ring", "--spectrum", "1", "0", "0", "1"}).find("--spectrum") != std::string::npos);
    CHECK(message({"ring", "--iterations", "1e9"}).find("--iterations") != std::string::npos);
    CHECK(message({"ring", "--samples", "0"}).find("--samples") != std::string::npos);
    CHECK(message({"ring", "--kernel", "cone"}).find("'cone'") != std::string::npos);
    CHECK(message({}).find("name a subject") == 0);
    CHECK(message({"ring", "--constrain", "perhaps"}).find("'perhaps'") != std::string::npos);

    ThreadExecutor threads(1);
    CHECK_THROWS_WITH_AS((void)make_subject(small("nowhere"), threads), doctest::Contains("'nowhere' is neither"),
                         UsageError);
    CHECK_THROWS_WITH((void)make_subject(small("no-such.png"), threads), "cannot read 'no-such.png'");
}

TEST_CASE("edge_width: a ramp of width w has 0.8 w wherever it lies") {
    const Edge edge{"ramp", 2, 5, {{{0.5, 0.1}, {1, 0}}, {{0.5, 0.7}, {1, 0}}}};
    for (const double shift : {0.0, 0.013}) {
        const auto ramp = [&](double x, double) {
            return 2 + 3 * std::clamp((x - 0.5 - shift) / 0.05 + 0.5, 0.0, 1.0);
        };
        const EdgeProfile profile = edge_profile(edge, 0.06, 121, ramp);
        CHECK(profile.offset(0) == -0.06);
        // Linear between offsets, but for the two next to the ramp's ends, which 10% and 90% are not.
        CHECK(edge_width(edge, profile) == doctest::Approx(0.04).epsilon(1e-9));
    }
}

TEST_CASE("edge_width: a step is as wide as the offsets are apart and what stays below 90% has no width") {
    const Edge edge{"step", 0, 1, {{{0, 0}, {0, 1}}}};
    const EdgeProfile step = edge_profile(edge, 0.1, 101, [](double, double y) { return y < 0.0005 ? 0.0 : 1.0; });
    CHECK(edge_width(edge, step) == doctest::Approx(0.8 * 0.002));
    const EdgeProfile dim = edge_profile(edge, 0.1, 101, [](double, double y) { return y < 0 ? 0.0 : 0.8; });
    CHECK(std::isnan(edge_width(edge, dim)));
    const EdgeProfile bright = edge_profile(edge, 0.1, 101, [](double, double) { return 1.0; });
    CHECK(std::isnan(edge_width(edge, bright)));
}

// The densest lattice of places that matters: 1000 × 1000, whose mean is off by the pixels that edges cross, 1e-3 at
// most.
TEST_CASE("pattern: the ellipse and the bars have the mean and the edges that they say") {
    const Pattern bars = pattern("ellipse-and-bars");
    double sum = 0;
    for (int i = 0; i < 1000; ++i)
        for (int j = 0; j < 1000; ++j)
            sum += bars.density((i + 0.5) / 1000, (j + 0.5) / 1000);
    CHECK(sum / 1e6 == doctest::Approx(bars.mean).epsilon(1e-3));
    REQUIRE(bars.edges.size() == 2);
    for (const Edge& edge : bars.edges) {
        CHECK(edge.inside == doctest::Approx(10 * edge.outside));
        std::size_t wrong = 0;
        for (const Edge::Place& place : edge.places) {
            const auto density = [&](double offset) {
                return bars.density(place.position[0] + offset * place.inward[0],
                                    place.position[1] + offset * place.inward[1]);
            };
            wrong += density(-1e-6) != 0.1 || density(1e-6) != 1 ||
                     std::abs(std::hypot(place.inward[0], place.inward[1]) - 1) > 1e-12;
        }
        CHECK(wrong == 0);
    }
    CHECK(pattern("uniform").density(0.3, 7) == 1);
    CHECK_FALSE(is_pattern("ring"));
}

// Random photons: those in the bright part are binomial, sqrt(4000 * 0.75 * 0.25) = 27.
TEST_CASE("pattern: photons lie as densely as it says and carry the picture's light") {
    Options options = small("ellipse-and-bars");
    options.sequence = SequenceKind::random;
    const Subject subject = pattern_subject(options);
    const Pattern bars = pattern("ellipse-and-bars");
    double bright = 0, inside = 0;
    for (const StoredPhoton& photon : subject.photons)
        if (in_unit_square(photon)) {
            ++inside;
            bright += bars.density(static_cast<double>(photon.position.x), static_cast<double>(photon.position.y)) == 1;
        }
    CHECK(inside == 4000);
    const double expected = (bars.mean - 0.1) / 0.9 / bars.mean;
    CHECK(std::abs(bright / inside - expected) < 5 * std::sqrt(expected * (1 - expected) / inside));
    CHECK(total_flux(subject.photons) > 1);
    REQUIRE(subject.truth.has_value());
    double mean = 0;
    for (const double e : *subject.truth)
        mean += e / static_cast<double>(subject.truth->size());
    CHECK(mean == doctest::Approx(1).epsilon(1e-3)); // columns are 1/3072 wide, and bars 0.08
}

TEST_CASE("pattern: a guide image is a density, linear, with its rows the right way up") {
    const TemporaryFolder folder;
    Image<float> guide(8, 4); // a quarter as bright below as above
    for (std::size_t i = 0; i < guide.pixels.size(); ++i)
        guide.pixels[i] = i < 16 ? 0.2f : 0.8f;
    write_png(folder / "guide.png", guide);
    const Pattern drawn = guide_pattern(folder / "guide.png");
    CHECK(drawn.density(0.5, 0.9) == 1);
    CHECK(drawn.density(0.5, 0.1) == doctest::Approx(0.25).epsilon(0.02)); // 8 bits of sRGB
    CHECK(drawn.density(-3, 1.5) == 1);
    CHECK(drawn.mean == doctest::Approx(0.625).epsilon(0.01));

    Image<Rgb> colour(1, 1, Rgb{0.0f, 1.0f, 0.0f});
    write_png(folder / "green.png", colour);
    CHECK(brightness(read_png(folder / "green.png")).pixels[0] == doctest::Approx(0.7152f));

    write_png(folder / "black.png", Image<float>(2, 2));
    CHECK_THROWS_WITH((void)guide_pattern(folder / "black.png"), doctest::Contains("is black"));
    write_bytes(folder / "broken.png", "no picture");
    CHECK_THROWS_WITH((void)guide_pattern(folder / "broken.png"), doctest::Contains("is no PNG that can be read"));
}

TEST_CASE("relaxation: a built-in case brings its photons and its exact picture, and the wave's go on beyond it") {
    ThreadExecutor threads(1);
    const Subject wave = make_subject(small("wave-prefocal"), threads);
    const auto inside = std::ranges::count_if(wave.photons, in_unit_square);
    CHECK(inside == 4000); // every emitted one arrives, wrapped
    // The margin of 0.15 on every side makes 1.69 times the area; the light has period 1, so that the parts beyond are
    // copies, and random only in how many fall into them.
    CHECK(static_cast<double>(wave.photons.size()) == doctest::Approx(4000 * 1.69).epsilon(0.05));
    REQUIRE(wave.truth.has_value());
    CHECK(wave.truth->size() == 48 * 48);
    CHECK(wave.vertices.size() == 48 * 48);
}

TEST_CASE("relaxation: a file's photons are moved on its surfaces") {
    const TemporaryFolder folder;
    write_bytes(folder / "scene.glb", caustic_scene().glb());
    ThreadExecutor threads(1);
    Options options = small((folder / "scene.glb").string());
    options.photons = 1500;
    options.relaxation.iterations = 3;
    const Subject subject = make_subject(options, threads);
    CHECK_FALSE(subject.floor.has_value());
    CHECK_FALSE(subject.truth.has_value());
    REQUIRE(subject.project);
    // Above the photon, as far as it has moved aside: back down. The scene's receiver is a horizontal square.
    const glm::vec3 p = subject.photons[0].position, n = subject.photons[0].normal;
    const glm::vec3 back = subject.project(0, p + glm::vec3(0.01f, 0, 0) + 0.005f * n);
    CHECK(dot(back - p, n) == doctest::Approx(0).epsilon(1e-5));

    const BeforeAndAfter study = before_and_after(subject, options, threads);
    CHECK(study.relaxed.size() == subject.photons.size());
    CHECK(total_flux(study.relaxed) == total_flux(subject.photons));
    CHECK_FALSE(study.before.best.has_value());
    CHECK(errors_table(options, subject, study).rows.size() == 4);    // two numbers of neighbours, before and after
    CHECK_FALSE(verdict_row(options, study).has_value());             // as the truth is not known
    CHECK(write_pictures(folder.path(), subject, study).size() == 4); // no dots, as it is not a floor
    CHECK(std::filesystem::exists(folder / "after-20.png"));
}

TEST_CASE("relaxation: the test pattern is less noisy with 20 neighbours, and holding its edges keeps them narrow" *
          doctest::skip(is_sanitized)) {
    ThreadExecutor threads(1);
    Options options = small("ellipse-and-bars");
    options.photons = 8000;
    options.neighbours = {20};
    options.sweep = {20};
    options.relaxation.iterations = 10;
    Subject subject = pattern_subject(options);
    subject.edges.pop_back(); // the bars are enough
    const BeforeAndAfter held = before_and_after(subject, options, threads);
    const Look &before = held.before.looks[0], &after = held.after.looks[0];
    CHECK(after.errors->relative < before.errors->relative);
    CHECK(after.errors->ssim > before.errors->ssim);
    CHECK(after.edge_widths[0] < 1.1 * before.edge_widths[0]);
    CHECK(held.weights.size() == subject.photons.size());

    options.relaxation.constrain = false;
    options.relaxation.rho = 0;
    const BeforeAndAfter free = before_and_after(subject, options, threads);
    CHECK_FALSE(free.after.looks[0].edge_widths[0] < 1.3 * before.edge_widths[0]); // or too wide to be seen
    CHECK(free.weights.empty());
}

TEST_CASE("relaxation: a study is the same bits for any number of threads") {
    Options options = small("ellipse-and-bars");
    options.relaxation.iterations = 4;
    Subject subject = pattern_subject(options);
    for (Edge& edge : subject.edges)
        edge.places.resize(16);
    ThreadExecutor one(1), three(3);
    const BeforeAndAfter a = before_and_after(subject, options, one), b = before_and_after(subject, options, three);
    CHECK(std::memcmp(a.relaxed.data(), b.relaxed.data(), a.relaxed.size() * sizeof(StoredPhoton)) == 0);
    CHECK(a.after.looks[0].picture.pixels == b.after.looks[0].picture.pixels);
    CHECK(a.after.looks[0].edge_widths == b.after.looks[0].edge_widths);
}

// Ten windows of white noise: an anisotropy of -10 dB. The means are over hundreds of frequencies and ten windows.
TEST_CASE("relaxation: random photons are white noise before and blue after") {
    ThreadExecutor threads(1);
    Options options = small("uniform");
    options.photons = 6000;
    options.sequence = SequenceKind::random;
    options.relaxation.iterations = 20;
    options.relaxation.constrain = false;
    options.relaxation.final_relaxation = 1;
    options.neighbours = options.sweep = {20};
    const Subject subject = pattern_subject(options);
    const BeforeAndAfter study = before_and_after(subject, options, threads);
    REQUIRE((study.before.blue_noise && study.after.blue_noise));
    CHECK(study.before.blue_noise->principal == doctest::Approx(principal_frequency(6000.0 / 16)).epsilon(0.05));
    CHECK(std::abs(decibels(study.before.blue_noise->low_power)) < 1);
    CHECK(std::abs(decibels(study.before.blue_noise->anisotropy) + 10) < 1);
    CHECK(decibels(study.after.blue_noise->low_power) < -10);
    CHECK(decibels(study.after.blue_noise->anisotropy) < -8);
    CHECK_THROWS_WITH((void)blue_noise(subject.photons, {0, 0.01, 0, 0.01}, threads),
                      doctest::Contains("too few photons"));

    const TemporaryFolder folder;
    CHECK(write_pictures(folder.path(), subject, study).size() == 8);
    const std::vector<examples::study::Drawing> plots = drawings(subject, study);
    REQUIRE(plots.size() == 2);
    CHECK(plots[0].name == "spectrum-power");
    CHECK(plots[1].curves.size() == 2);
    CHECK(spectrum_table(study).rows.size() == 2);
    for (const char* name : {"truth.png", "before-20.png", "after-20.png", "before-best.png", "dots-before.png",
                             "dots-after.png", "spectrum-before.png", "spectrum-after.png"})
        CHECK_MESSAGE(std::filesystem::exists(folder / name), name);
    const std::string csv = csv_text(subject, study);
    CHECK(csv.starts_with("map,neighbours,seconds,rel,RMSE,SSIM,energy\nunrelaxed,20,"));
    CHECK(std::ranges::count(csv, '\n') == 5);
}

} // namespace nephroid::examples::relax_test
