// SPDX-License-Identifier: MIT
#include "common/study/light_tracing.hpp"

#include "common/stopwatch.hpp"
#include "common/study/bench.hpp"

namespace nephroid::examples::study {

namespace {

template <std::size_t N>
[[nodiscard]] std::vector<float> picture_of(const BuiltinFilm& film, const Deposits<N>& deposits) {
    const FilmRectangle& view = film.view;
    const double columns = double(film.width) / (view.x_max - view.x_min);
    const double rows = double(film.height) / (view.y_max - view.y_min);
    std::vector<float> irradiance(film.pixels());
    for (const auto& deposit : deposits) {
        const double x = columns * (double(deposit.position.x) - view.x_min);
        const double y = rows * (double(deposit.position.y) - view.y_min);
        if (deposit.normal.z > 0 && x >= 0 && y >= 0 && x < double(film.width) && y < double(film.height))
            irradiance[std::size_t(y) * film.width + std::size_t(x)] +=
                static_cast<float>(columns * rows) * deposit.flux;
    }
    return irradiance;
}

} // namespace

Estimate count_in_pixels(const Bench& bench, const Photons& photons, double, Source source) {
    Estimate result;
    Stopwatch stopwatch;
    const Deposits<0> traced = source == Source::lamp ? bench.trace_bare(photons, 0, photons.emitted) : Deposits<0>{};
    result.seconds.trace = source == Source::lamp ? stopwatch.lap() : photons.bare_trace_seconds;
    stopwatch = {};
    result.irradiance =
        source == Source::lamp ? picture_of(bench.film(), traced) : picture_of(bench.film(), photons.deposits);
    result.seconds.estimate = stopwatch.lap();
    return result;
}

} // namespace nephroid::examples::study
