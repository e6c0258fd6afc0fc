// SPDX-License-Identifier: MIT
// `study compare` from within: finding a bandwidth, what is needed for an equal error, methods that agree.
#include "common/image/pfm.hpp"
#include "common/image/png.hpp"
#include "common/study/bench.hpp"
#include "common/study/compare/command.hpp"
#include "common/study/compare/page.hpp"
#include "common/study/compare/pictures.hpp"
#include "common/study/compare/plots.hpp"
#include "common/study/compare/tables.hpp"
#include "common/study/equal.hpp"
#include "support/is_sanitized.hpp"
#include "support/temporary_folder.hpp"

#include <CLI/CLI.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace nephroid::examples::compare_test {

using namespace nephroid::examples::study;
using namespace nephroid::examples::study::compare;
using namespace nephroid::tests;

namespace {

[[nodiscard]] Options read(std::initializer_list<const char*> arguments) {
    CLI::App app;
    const Command command(app);
    std::vector<const char*> argv{"compare"};
    argv.insert(argv.end(), arguments);
    REQUIRE(parse(app, static_cast<int>(argv.size()), argv.data()));
    return command.options();
}

[[nodiscard]] Options small(const std::string& scene) {
    Options options;
    options.scene = scene;
    options.methods = {"splat", "nearest"};
    options.photons = {1000};
    options.sequences = {SequenceKind::halton};
    options.width = options.height = 32;
    options.threads = 2;
    options.repeats = 1;
    return options;
}

/// Trials whose errors and seconds are powers of the number of photons.
struct PowerLaws {
    std::vector<Trial> trials;

    PowerLaws(double error, double error_power, double seconds, double seconds_power) {
        for (const std::uint64_t photons : {1000u, 10'000u, 100'000u}) {
            Trial trial;
            trial.method = find_method("nearest");
            trial.wanted = photons;
            for (Best& best : trial.best) {
                best.errors.relative = best.errors.rmse = error * std::pow(double(photons), error_power);
                best.errors.ssim = 1 - best.errors.relative;
                best.timing.seconds.estimate = seconds * std::pow(double(photons), seconds_power);
            }
            trials.push_back(trial);
        }
    }
    [[nodiscard]] std::vector<const Trial*> own() const { return trials_of(trials, "nearest", SequenceKind{}); }
};

[[nodiscard]] double largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = (std::max)(most, double(std::abs(a[i] - b[i])));
    return most;
}

[[nodiscard]] double largest(const std::vector<float>& picture) { return double(*std::ranges::max_element(picture)); }

} // namespace

TEST_CASE("compare: options are read with lists sorted and without doubles") {
    const auto options = read({"ring", "--methods", "splat,nearest,splat", "--photons", "1e5,2000,1e5", "--sequence",
                               "random", "--size", "64x32", "--sweep"});
    CHECK(options.methods == std::vector<std::string>{"splat", "nearest"});
    CHECK(options.photons == std::vector<std::uint64_t>{2000, 100'000});
    CHECK(options.sequences == std::vector<SequenceKind>{SequenceKind::random});
    CHECK(options.width == 64);
    CHECK(options.height == 32);
    CHECK(options.sweep);
    CHECK(target_photons(options) == 2000);
    CHECK(read({"ring", "--methods", "all"}).methods.size() == methods().size());
    CHECK(read({"ring"}).methods.size() == methods().size() - 1); // but for a slow one
    CHECK(target_photons(read({"ring"})) == 20'000);
}

// A parabola in the logarithm of the bandwidth with its bottom between two points of the grid.
TEST_CASE("compare: a sweep finds the best point of its grid from afar with few evaluations") {
    for (const double bottom : {0.9, 11.0, 150.0}) {
        CAPTURE(bottom);
        const auto error = [&](double h) { return 0.1 + std::pow(std::log2(h / bottom), 2); };
        int evaluations = 0;
        BandwidthSweep sweep({10, 0.1, 1000, std::pow(2, 0.25)}, [&](double h) {
            ++evaluations;
            return Errors{.relative = error(h), .rmse = error(h / 4), .ssim = 1 - error(h)};
        });
        // Neighbours are a quarter of a doubling apart: the best is at most half of that from the bottom.
        CHECK(std::abs(std::log2(sweep.best(Measure::relative) / bottom)) <= 0.125 + 1e-9);
        const int needed = evaluations;
        CHECK(needed <= 9 + 4); // strides of a doubling, from 10 down to 0.9 and up to 150, are four more
        CHECK(sweep.best(Measure::ssim) == sweep.best(Measure::relative));
        CHECK(evaluations <= needed + 4); // of neighbours that the first walk did not see
        if (bottom < 100)
            CHECK(std::abs(std::log2(sweep.best(Measure::rmse) / (4 * bottom))) <= 0.125 + 1e-9);
        CHECK(int(sweep.evaluated().size()) == evaluations);
    }
}

TEST_CASE("compare: a sweep sees a second and deeper valley at wider kernels") {
    BandwidthSweep sweep({10, 0.1, 1000, std::pow(2, 0.25)}, [](double h) {
        const double first = 0.3 + std::abs(std::log2(h / 10)), second = 0.1 + 0.3 * std::abs(std::log2(h / 40));
        return Errors{.ssim = 1 - (std::min)(first, second)};
    });
    CHECK(sweep.best(Measure::ssim) == doctest::Approx(40));
}

TEST_CASE("compare: a sweep keeps to its limits and to whole numbers") {
    const auto downhill = [](double h) { return Errors{.relative = 1 / h}; };
    BandwidthSweep limited({10, 1, 50, 2}, downhill);
    CHECK(limited.best(Measure::relative) == 40);
    BandwidthSweep whole({10, 4, 50, std::sqrt(2), true}, downhill);
    static_cast<void>(whole.best(Measure::relative));
    for (const auto& [bandwidth, errors] : whole.evaluated())
        CHECK(bandwidth == std::round(bandwidth));
    BandwidthSweep beyond({1000, 1, 50, 2}, downhill);
    CHECK(beyond.best(Measure::relative) == 50);
}

TEST_CASE("compare: effort between the counts measured follows power laws exactly") {
    const PowerLaws laws(2, -0.5, 1e-4, 1);
    for (const Measure measure : measures) {
        const Effort effort = effort_for(laws.own(), measure, 2 / std::sqrt(30'000));
        CHECK(effort.bound == Bound::within);
        CHECK(effort.photons == doctest::Approx(30'000));
        CHECK(effort.seconds == doctest::Approx(3));
        CHECK(slope_of(laws.own(), measure).value() == doctest::Approx(-0.5));
    }
    CHECK(effort_for(laws.own(), Measure::rmse, 1).bound == Bound::at_most);
    CHECK(effort_for(laws.own(), Measure::rmse, 1).photons == 1000);
    CHECK(effort_for(laws.own(), Measure::rmse, 1e-3).bound == Bound::more_than);
    CHECK(effort_for(laws.own(), Measure::rmse, 1e-3).photons == 100'000);
}

TEST_CASE("compare: what is reached in a time follows power laws exactly") {
    const PowerLaws laws(2, -0.5, 1e-4, 1);
    const Reached reached = reached_after(laws.own(), Measure::relative, 3);
    CHECK(reached.bound == Bound::within);
    CHECK(reached.cost == doctest::Approx(2 / std::sqrt(30'000)));
    CHECK(reached_after(laws.own(), Measure::relative, 0.01).bound == Bound::more_than);
    CHECK(reached_after(laws.own(), Measure::relative, 100).bound == Bound::at_most);
}

// The same photons and bandwidth: only the order of sums and the scaling of tangents differ, which are roundings. A
// footprint whose border passes a vertex may change by about epsilon there, as the kernels are continuous.
TEST_CASE("compare: every method makes the same picture from stored photons as from the lamp") {
    for (const char* scene : {"wave-focused", "ring"}) {
        Options options = small(scene);
        const Bench bench(options);
        const Photons photons = bench.trace(SequenceKind::halton, is_sanitized ? 500 : 2000);
        for (const Method& listed : methods()) {
            std::vector<Method> settings = listed.settings;
            settings.push_back(listed);
            for (const Method& method : settings) {
                CAPTURE(scene);
                CAPTURE(method.id);
                CAPTURE(method.setting);
                const double bandwidth = std::round(100 * method.expected(bench, photons)) / 100;
                const Estimate stored = method.run(bench, photons, bandwidth, Source::stored);
                const Estimate lamp = method.run(bench, photons, bandwidth, Source::lamp);
                CHECK(largest_difference(stored.irradiance, lamp.irradiance) <= 1e-3 * largest(lamp.irradiance));
                CHECK(lamp.seconds.trace > 0);
                CHECK((lamp.seconds.build > 0 || method.id == "light-tracing")); // which has no map
                CHECK(lamp.seconds.estimate > 0);
                // The k nearest photons do not keep energy, few of them at folds least of all: an eighth is gained
                // here. An area or a flux that is wrong by a factor is off by more than this.
                CHECK(std::abs(bench.errors(lamp.irradiance).energy) < 0.25);
            }
        }
    }
}

// Photons that land in a pixel add up to its irradiance times its area, whatever the pixel's size.
TEST_CASE("compare: light tracing keeps all flux that lands on the film") {
    const Bench bench(small("wave-prefocal"));
    const Photons photons = bench.trace(SequenceKind::halton, 1000);
    const auto picture = find_method("light-tracing")->run(bench, photons, 1, Source::stored).irradiance;
    double landed = 0, counted = 0;
    for (const auto& deposit : photons.deposits) // the film is the floor's whole period
        landed += double(deposit.flux);
    for (const float pixel : picture)
        counted += double(pixel) / (32 * 32);
    CHECK(counted == doctest::Approx(landed).epsilon(1e-4)); // sums of floats, some photons to a pixel
}

TEST_CASE("compare: splatting and gathering the same footprints makes the same picture") {
    const Bench bench(small("wave-prefocal"));
    const Photons photons = bench.trace(SequenceKind::random, 1000);
    const auto splatted = find_method("splat")->run(bench, photons, 7, Source::stored).irradiance;
    const auto gathered = find_method("differential-map")->run(bench, photons, 7, Source::stored).irradiance;
    CHECK(largest_difference(splatted, gathered) <= 1e-5 * largest(splatted)); // sums of some dozen floats
}

TEST_CASE("compare: a noisy reference's own noise is taken out of rel") {
    const TemporaryFolder folder;
    Options options = small("wave-prefocal");
    const Bench exact(options);
    // Each pixel of the reference is off by its standard error, in a pattern that no picture follows.
    std::vector<float> noisy, standard_error;
    double mean = 0;
    for (const double pixel : exact.reference())
        mean += pixel / double(exact.reference().size());
    for (std::size_t i = 0; i < exact.reference().size(); ++i) {
        standard_error.push_back(static_cast<float>(0.1 * mean));
        noisy.push_back(static_cast<float>(exact.reference()[i] + ((i * 7919 % 64 < 32) ? 0.1 : -0.1) * mean));
    }
    options.reference = folder.path() / "mean.pfm";
    options.standard_error = folder.path() / "error.pfm";
    write_pfm(*options.reference, {32, 32, 1, noisy});
    write_pfm(*options.standard_error, {32, 32, 1, standard_error});
    const Bench bench(options);
    CHECK(bench.reference_noise() == doctest::Approx(0.1).epsilon(1e-3));
    const std::vector<float> perfect(exact.reference().begin(), exact.reference().end());
    CHECK(bench.errors(perfect).relative < 0.01); // 0.1 without the correction
    CHECK_FALSE(bench.is_exact());
}

TEST_CASE("compare: a small comparison fills its tables and its page") {
    const TemporaryFolder folder;
    Options options = small("wave-prefocal");
    options.photons = {500, 1000};
    const Bench bench(options);
    const auto trials = all_trials(options, bench, [&](Trial& trial) { write_pictures(folder.path(), bench, trial); });
    REQUIRE(trials.size() == 4);
    for (const Trial& trial : trials)
        for (const Measure measure : measures) {
            CHECK(trial.by(measure).timing.repeats == 1);
            const Best& best = trial.by(measure);
            int found = 0;
            for (const Sweep& sweep : trial.sweeps) {
                found += sweep.method == best.method && sweep.errors.contains(best.bandwidth);
                for (const auto& [bandwidth, errors] : sweep.errors)
                    CHECK(cost_of(errors, measure) >= 0.999 * trial.cost(measure));
            }
            CHECK(found == 1);
        }
    CHECK(equal_error_tables(options, trials).size() == 1);
    CHECK(equal_time_tables(options, trials).size() == 2);
    CHECK(best_table(trials, Measure::rmse).rows.size() == 4);

    write_png(folder.path() / "reference.png", {32, 32, 1, {bench.reference().begin(), bench.reference().end()}});
    const auto strips = write_strips(folder.path(), options, bench, trials);
    REQUIRE(strips.size() == 2);
    CHECK(strips[0].exhibits.size() == 3);
    CHECK(drawings(options, trials).size() == 9); // three kinds, three measures
    Page page("a <\"&> case");
    begin_page(page, options, bench, trials, folder.path());
    page.plots({});
    page.strip(strips[0]);
    page.table(best_table(trials, Measure::rmse));
    end_page(page, options);
    const std::string html = page.html();
    CHECK(html.find("a &lt;&quot;&amp;&gt; case") != std::string::npos);
    CHECK(html.find("gnuplot was missing") != std::string::npos);
    CHECK(html.find("http") == std::string::npos);
}

} // namespace nephroid::examples::compare_test
