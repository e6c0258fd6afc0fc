// SPDX-License-Identifier: MIT
#include "common/study/bench.hpp"

#include "common/caustic_photons.hpp"
#include "common/image/pfm.hpp"
#include "common/stopwatch.hpp"

#include "nephroid/gather/trace_photons.hpp"
#include "nephroid/quality/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephroid::examples::study {

namespace {

/// Caustic photons in a pass of the progressive methods.
constexpr std::uint64_t photons_per_pass = 20'000;

[[nodiscard]] std::vector<double> read_pixels(const std::filesystem::path& path, const BuiltinFilm& film) {
    const Samples picture = read_pfm(path);
    if (picture.channels != 1 || picture.width != film.width || picture.height != film.height)
        throw std::runtime_error("'" + path.string() + "' is " + std::to_string(picture.width) + " x " +
                                 std::to_string(picture.height) + " x " + std::to_string(picture.channels) +
                                 " samples; asked for were " + std::to_string(film.width) + " x " +
                                 std::to_string(film.height) + ", grey");
    for (const float sample : picture.samples)
        if (!std::isfinite(sample) || sample < 0)
            throw std::runtime_error("'" + path.string() + "' has a pixel of " + std::to_string(sample));
    return {picture.samples.begin(), picture.samples.end()};
}

[[nodiscard]] BuiltinFilm film_of(const Options& options, FilmRectangle view) {
    if (options.view)
        view = {(*options.view)[0], (*options.view)[1], (*options.view)[2], (*options.view)[3]};
    return {options.scene, view, options.width, options.height, options.samples, options.fresnel, false};
}

} // namespace

Bench::Bench(const Options& options)
    : options_(options), case_(builtin_case<float, float>(options.scene, options.fresnel).value()),
      film_(film_of(options, case_.film)), limits_(walk_limits(film_)),
      threads_(std::make_unique<ThreadExecutor>(options.threads)), vertices_(floor_vertices(film_)) {
    check(film_);
    read_reference();
    if (!std::ranges::any_of(reference_, [](double pixel) { return pixel > 0; }))
        throw std::runtime_error("no light falls on this film, so there is nothing to compare");
    exposure_ = picture_exposure(reference_);
}

void Bench::read_reference() {
    if (!options_.reference) {
        auto exact = exact_picture(film_, options_.threads);
        if (!exact)
            throw UsageError("--reference: the exact picture of " + options_.scene +
                             " is not known; give a .pfm, as the program reference_path_tracer makes it");
        reference_ = std::move(*exact);
        return;
    }
    reference_ = read_pixels(*options_.reference, film_);
    if (!options_.standard_error)
        return;
    double square = 0, sum = 0;
    for (const double error : read_pixels(*options_.standard_error, film_))
        square += error * error;
    for (const double pixel : reference_)
        sum += pixel;
    noise_ = sum > 0 ? std::sqrt(square * double(film_.pixels())) / sum : 0;
}

Photons Bench::trace(SequenceKind kind, std::uint64_t wanted) const {
    Photons photons;
    photons.sequence = kind;
    photons.samples = make_sequence(kind, options_.seed);
    photons.wanted = wanted;
    const std::size_t passes = (std::max)(std::uint64_t(1), (wanted + photons_per_pass / 2) / photons_per_pass);
    photons.pass_begin.resize(passes + 1);
    std::visit(
        [&](const auto& sequence) {
            photons.emitted = emit_for(case_.scene, case_.light, wanted, limits_, sequence, *threads_);
            Stopwatch stopwatch;
            for (std::size_t pass = 0; pass < passes; ++pass) {
                const std::uint64_t first = photons.first_of_pass(pass);
                const auto traced = trace_photons(case_.scene, case_.light,
                                                  PhotonPass{.first = first,
                                                             .count = photons.first_of_pass(pass + 1) - first,
                                                             .total = photons.emitted,
                                                             .smoothing = 1,
                                                             .limits = limits_},
                                                  sequence, *threads_);
                photons.deposits.insert(photons.deposits.end(), traced.deposits.begin(), traced.deposits.end());
                photons.pass_begin[pass + 1] = photons.deposits.size();
            }
            photons.trace_seconds = stopwatch.lap();
            const PhotonPass all{.count = photons.emitted, .smoothing = 1, .limits = limits_};
            static_cast<void>(trace_photons(case_.scene, WithoutTangents(case_.light), all, sequence, *threads_));
            photons.bare_trace_seconds = stopwatch.lap();
        },
        photons.samples);
    return photons;
}

Deposits<0> Bench::trace_bare(const Photons& photons, std::uint64_t first, std::uint64_t end) const {
    const PhotonPass pass{
        .first = first, .count = end - first, .total = photons.emitted, .smoothing = 1, .limits = limits_};
    return std::visit(
        [&](const auto& sequence) {
            return trace_photons(case_.scene, WithoutTangents(case_.light), pass, sequence, *threads_).deposits;
        },
        photons.samples);
}

const FloorMap& Bench::map(double margin) const {
    const int step = case_.periodic ? static_cast<int>(std::ceil(margin / margin_step())) : 0;
    auto& map = maps_[step];
    if (!map)
        map = std::make_unique<FloorMap>(vertices_with_ghosts(margin));
    return *map;
}

std::vector<FloorVertex> Bench::vertices_with_ghosts(double margin) const {
    if (!case_.periodic)
        return vertices_;
    return floor_vertices(film_, margin_step() * std::ceil(margin / margin_step()));
}

double Bench::density(const Photons& photons) const {
    const FilmRectangle& view = film_.view;
    const auto is_on_film = [&](const auto& deposit) {
        return deposit.position.x >= view.x_min && deposit.position.x <= view.x_max &&
               deposit.position.y >= view.y_min && deposit.position.y <= view.y_max;
    };
    const auto count = std::ranges::count_if(photons.deposits, is_on_film);
    return (std::max)(1.0, double(count)) / ((view.x_max - view.x_min) * (view.y_max - view.y_min));
}

Errors Bench::errors(const std::vector<float>& irradiance) const {
    Errors errors = errors_against(reference_, irradiance, film_.width, film_.height).value();
    const double square = errors.relative * errors.relative - noise_ * noise_;
    errors.relative = std::sqrt((std::max)(0.0, square));
    return errors;
}

} // namespace nephroid::examples::study
