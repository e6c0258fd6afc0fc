// SPDX-License-Identifier: MIT
#include "common/study/judge/command.hpp"

#include "common/any_sequence.hpp"
#include "common/command_line.hpp"
#include "common/study/judge/scenes.hpp"
#include "common/study/options.hpp"
#include "common/text.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/quality/error.hpp"
#include "nephroid/receiver/eye_path_map.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <span>
#include <variant>
#include <vector>

namespace nephroid::examples::study::judge {

namespace {

struct FloorPoint {
    Vec3<float> position, normal;
};

[[nodiscard]] std::vector<FloorPoint> floor_of(const FilmRectangle& film, std::size_t size) {
    std::vector<FloorPoint> points;
    for (std::size_t j = 0; j < size; ++j)
        for (std::size_t i = 0; i < size; ++i) {
            const double x = (double(i) + 0.5) / double(size), y = (double(j) + 0.5) / double(size);
            points.push_back({Vec3<float>(float(film.x_min + x * (film.x_max - film.x_min)),
                                          float(film.y_min + y * (film.y_max - film.y_min)), 0),
                              Vec3<float>(0, 0, 1)});
        }
    return points;
}

/// Photons of the truth have indices that no picture reaches, and footprints that its number makes small.
constexpr std::uint64_t indices_of_truth = 1'000'000'000;
constexpr double smoothing_of_truth = 3;

/// Ratios of errors, their geometric mean and their largest.
class Ratios {
public:
    void add(double ratio) {
        logs_ += std::log(ratio);
        worst_ = (std::max)(worst_, ratio);
        ++count_;
    }
    [[nodiscard]] double mean() const { return count_ > 0 ? std::exp(logs_ / double(count_)) : 1; }
    [[nodiscard]] double worst() const { return worst_; }

private:
    double logs_ = 0, worst_ = 0;
    std::size_t count_ = 0;
};

/// The numbers of chosen names, all if none is named.
[[nodiscard]] std::vector<std::size_t> numbers_of(const char* option, const std::string& chosen,
                                                  std::span<const std::string_view> names) {
    std::vector<std::size_t> numbers;
    if (chosen.empty()) {
        for (std::size_t i = 0; i < names.size(); ++i)
            numbers.push_back(i);
        return numbers;
    }
    for (const std::string& word : listed(option, chosen)) {
        const auto found = std::find(names.begin(), names.end(), word);
        if (found == names.end())
            throw UsageError(std::string(option) + ": there is no '" + word + "'");
        numbers.push_back(std::size_t(found - names.begin()));
    }
    return numbers;
}

} // namespace

Command::Command(CLI::App& app) {
    app.add_option("--seed", seed_, "The first seed [11]. Rules are tuned on 1 to 10 and judged on others");
    app.add_option("--seeds", seeds_, "How many seeds [1]")->check(CLI::Range(1, 1000));
    app.add_option("--photons", photons_, "Numbers of photons, growing [5000,20000,200000]");
    app.add_option("--kinds", kinds_, "wave, slab, glass-ball, mirror-ball, ring, facets, mesh [all]");
    app.add_option("--lamps", lamps_, "sun, point, disk [all]");
    app.add_option("--sequence", sequence_, "halton, sobol, r2 or random [halton]");
    app.add_option("--truth", truth_, "Photons of the truth [2000000]")->check(CLI::Range(10'000, 1'000'000'000));
    app.add_option("--size", size_, "Pixels a side [128]")->check(CLI::Range(16, 2048));
    app.add_option("--threads", threads_, "[1]");
    app.add_flag("--best", best_, "Also against the best smoothing for all photons");
    app.add_option("--format", format_, "text or markdown")->check(CLI::IsMember({"text", "markdown"}));
}

void Command::run() const {
    const auto counts = read_photon_counts(photons_);
    const auto of_kinds = numbers_of("--kinds", kinds_, kinds), of_lamps = numbers_of("--lamps", lamps_, lamps);
    const auto sequences = read_sequences(sequence_);
    if (sequences.size() != 1)
        throw UsageError("--sequence: one at a time");
    const AnySequence sequence = make_sequence(sequences.front(), 0);
    check_threads(threads_);
    ThreadExecutor executor(threads_);
    Table table{"judge",
                "Scenes that no rule was tuned on",
                "rel of the published method at s = 8, and how many times that of it the default has" +
                    std::string(best_ ? "; / of the best s for all photons" : ""),
                {"scene"},
                {}};
    for (const std::uint64_t count : counts)
        table.header.insert(table.header.end(), {std::to_string(count) + ": published", "default"});
    std::vector<Ratios> ratios(counts.size()), of_best(counts.size());
    for (std::uint64_t seed = seed_; seed < seed_ + seeds_; ++seed)
        for (const std::size_t kind : of_kinds)
            for (const std::size_t lamp : of_lamps) {
                const auto one = scene_of(kind, lamp, seed);
                const auto points = floor_of(one.film, size_);
                const EyePathMap map(points, &FloorPoint::position, &FloorPoint::normal);
                const auto picture = [&](const PhotonPass& pass, const auto& policies) {
                    auto sums = nephroid::sums<float>(map);
                    std::visit(
                        [&](const auto& chosen) {
                            (void)caustics(one.scene, one.light, sums, pass, policies, chosen, executor);
                        },
                        sequence);
                    std::vector<double> irradiance(points.size());
                    sums.for_each([&](std::size_t vertex, float sum) { irradiance[vertex] = double(sum); });
                    return irradiance;
                };
                const std::vector<double> truth =
                    picture({.first = indices_of_truth, .count = truth_, .smoothing = smoothing_of_truth}, Published());
                const bool is_lit = std::any_of(truth.begin(), truth.end(), [](double e) { return e > 0; });
                TableRow row = {std::string(kinds[kind]) + ", " + std::string(lamps[lamp]) + ", " +
                                std::to_string(seed)};
                for (std::size_t i = 0; i < counts.size() && is_lit; ++i) {
                    const auto error = [&](const std::vector<double>& image) { return relative_error(image, truth); };
                    const double published = error(picture({.count = counts[i]}, Published())),
                                 chosen = error(picture({.count = counts[i]}, Default()));
                    std::string ratio = text("%.3f", chosen / published);
                    ratios[i].add(chosen / published);
                    if (best_) {
                        double least = published;
                        for (double s = 2; s < 64; s *= 1.25)
                            least =
                                (std::min)(least, error(picture({.count = counts[i], .smoothing = s}, Published())));
                        ratio += " / " + text("%.3f", chosen / least);
                        of_best[i].add(chosen / least);
                    }
                    row.insert(row.end(), {text("%.4f", published), ratio});
                }
                row.resize(table.header.size(), "dark");
                std::cerr << row[0] << std::endl;
                table.rows.push_back(std::move(row));
            }
    const auto add_summary = [&](const char* name, double (Ratios::*what)() const) {
        TableRow row = {name};
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const std::string best = best_ ? " / " + text("%.3f", (of_best[i].*what)()) : "";
            row.insert(row.end(), {"", text("%.3f", (ratios[i].*what)()) + best});
        }
        table.rows.push_back(std::move(row));
    };
    add_summary("geometric mean", &Ratios::mean);
    add_summary("worst", &Ratios::worst);
    print(std::cout, table, format_ == "markdown" ? TableFormat::markdown : TableFormat::text);
}

} // namespace nephroid::examples::study::judge
