// SPDX-License-Identifier: MIT
#include "common/study/methods.hpp"

#include "common/study/bench.hpp"
#include "common/study/gathering.hpp"
#include "common/study/light_tracing.hpp"
#include "common/study/sheet_drawing.hpp"
#include "common/study/splatting.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::examples::study {

namespace {

/// k photons lie within this distance where photons are spread as on the film at large.
[[nodiscard]] double distance_of(const Bench& bench, const Photons& photons, double k) {
    return std::sqrt(k / (std::numbers::pi * bench.density(photons)));
}

/// By how much random photons want wider kernels than stratified ones, in radius.
[[nodiscard]] double wideness(const Photons& photons) { return photons.sequence == SequenceKind::random ? 1.6 : 1; }

// What balances bias and variance on smooth light grows like this with the number of photons; folds want less.
[[nodiscard]] double growth(const Photons& photons, double power) {
    return std::pow(double(photons.wanted) / 20'000, power);
}

[[nodiscard]] double expected_smoothing(const Bench&, const Photons& photons) {
    return 6 * wideness(photons) * growth(photons, 0.2);
}
[[nodiscard]] double expected_count(const Bench&, const Photons& photons) {
    return 32 * wideness(photons) * growth(photons, 0.4);
}
[[nodiscard]] double expected_radius(const Bench& bench, const Photons& photons) {
    return distance_of(bench, photons, expected_count(bench, photons));
}
/// Of the first pass, wide enough for a pass's photons.
[[nodiscard]] double expected_first_smoothing(const Bench&, const Photons& photons) { return 8 * wideness(photons); }
[[nodiscard]] double expected_first_radius(const Bench& bench, const Photons& photons) {
    return distance_of(bench, photons, 40.0 * double(photons.passes()));
}

/// For a method without a bandwidth.
[[nodiscard]] double one(const Bench&, const Photons&) { return 1; }
[[nodiscard]] double least_smoothing(const Bench&, const Photons&) { return 0.25; }
/// Footprints of the whole film, or of a period.
[[nodiscard]] double most_smoothing(const Bench&, const Photons& photons) {
    return 0.25 * std::sqrt(std::numbers::pi * double(photons.emitted));
}
[[nodiscard]] double most_first_smoothing(const Bench& bench, const Photons& photons) {
    return most_smoothing(bench, photons) / std::sqrt(double(photons.passes()));
}
[[nodiscard]] double least_count(const Bench&, const Photons&) { return 4; }
[[nodiscard]] double most_count(const Bench&, const Photons& photons) { return 0.25 * double(photons.deposits.size()); }
/// With checking more photons are never much worse, so a sweep would go on: to what a user waits for.
[[nodiscard]] double most_checked_count(const Bench& bench, const Photons& photons) {
    return (std::min)(2048.0, most_count(bench, photons));
}
[[nodiscard]] double least_radius(const Bench& bench, const Photons&) { return 0.125 * bench.film().pixel(); }
[[nodiscard]] double most_radius(const Bench& bench, const Photons&) {
    return 0.25 * bench.film().pixel() * double(bench.film().width);
}

const double fine = std::pow(2.0, 0.25), fine_count = std::sqrt(2.0); // a disk's radius is the root of its photons

/// At the library's diffusivity, and at four times less and more, which suits all folds and none.
[[nodiscard]] Method diffusion() {
    Method method{"diffusion",
                  "diffusion-based photon mapping",
                  "Schjoth et al. 2008",
                  "h",
                  "radius, world units",
                  false,
                  fine,
                  expected_radius,
                  least_radius,
                  most_radius,
                  [](const Bench& bench, const Photons& photons, double radius, Source source) {
                      return gather_by_diffusion(bench, photons, radius, 0.4, source);
                  },
                  "C = 0.4"};
    Method strong = method, weak = method;
    strong.setting = "C = 0.1";
    strong.run = [](const Bench& bench, const Photons& photons, double radius, Source source) {
        return gather_by_diffusion(bench, photons, radius, 0.1, source);
    };
    weak.setting = "C = 1.6";
    weak.run = [](const Bench& bench, const Photons& photons, double radius, Source source) {
        return gather_by_diffusion(bench, photons, radius, 1.6, source);
    };
    method.settings = {strong, weak};
    return method;
}

} // namespace

std::string bandwidth_text(const Method& method, double bandwidth) {
    if (method.symbol.empty())
        return "nothing to choose";
    return method.symbol + " = " + (method.is_whole ? text("%.0f", bandwidth) : text("%.3g", bandwidth)) +
           (method.setting.empty() ? "" : ", " + method.setting);
}

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        {"splat", "photon differential splatting", "Frisvad et al. 2014", "s", "smoothing", false, fine,
         expected_smoothing, least_smoothing, most_smoothing, splat},
        {"splat-second", "second-order splatting", "nephroid", "s", "smoothing", false, fine, expected_smoothing,
         least_smoothing, most_smoothing, splat_second_order},
        {"splat-auto", "second-order splatting, s chosen by itself", "nephroid", "", "none", false, fine, one, one, one,
         splat_without_parameter},
        {"sheets", "light sheets", "nephroid", "", "none", false, fine, one, one, one, draw_sheets},
        {"progressive-splat", "progressive differential splatting", "nephroid", "s", "smoothing of the first pass",
         false, fine, expected_first_smoothing, least_smoothing, most_first_smoothing, splat_progressively},
        {"fixed", "fixed-bandwidth splatting", "Lavignotte and Paulin 2003", "r", "radius, world units", false, fine,
         expected_radius, least_radius, most_radius, splat_disks},
        {"nearest", "photon mapping, biweight", "Jensen 1996", "k", "nearest photons", true, fine_count, expected_count,
         least_count, most_count, gather_nearest},
        {"nearest-constant", "photon mapping, constant kernel", "Jensen 1996", "k", "nearest photons", true, fine_count,
         expected_count, least_count, most_count, gather_nearest_constant},
        {"nearest-checked", "photon mapping, differential checking", "Jensen and Christensen 1995", "k",
         "nearest photons, at most", true, fine_count, expected_count, least_count, most_checked_count,
         gather_nearest_checked},
        {"differential-map", "photon differential mapping", "Schjoth et al. 2007", "s", "smoothing", false, fine,
         expected_smoothing, least_smoothing, most_smoothing, gather_differentials},
        diffusion(),
        {"progressive", "progressive photon mapping", "Hachisuka et al. 2008", "r",
         "radius of the first pass, world units", false, fine, expected_first_radius, least_radius, most_radius,
         gather_progressively},
        {"progressive-radius", "progressive photon mapping, biweight", "Knaus and Zwicker 2011", "r",
         "radius of the first pass, world units", false, fine, expected_first_radius, least_radius, most_radius,
         gather_by_shrinking_radius},
        {"light-tracing", "light tracing, aimed at the specular objects", "Arvo 1986", "", "none", false, fine, one,
         one, one, count_in_pixels},
    };
    return all;
}

const Method* find_method(const std::string& id) {
    const auto found = std::ranges::find(methods(), id, &Method::id);
    return found == methods().end() ? nullptr : &*found;
}

std::string method_names() {
    std::string names;
    for (const Method& method : methods())
        names += (names.empty() ? "" : ", ") + method.id;
    return names;
}

} // namespace nephroid::examples::study
