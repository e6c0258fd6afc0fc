// SPDX-License-Identifier: MIT
#include "common/study/relax/pictures.hpp"

#include "common/image/png.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study::relax {

namespace {

/// The exposure that shows nineteen in twenty of the lit pixels below 0.7: a caustic's folds may shine.
[[nodiscard]] double exposure_for(std::vector<double> brightness) {
    std::erase_if(brightness, [](double b) { return !(b > 0); });
    if (brightness.empty())
        return 1;
    const auto bright = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() * 19 / 20);
    std::nth_element(brightness.begin(), bright, brightness.end());
    return 0.7 / *bright;
}

[[nodiscard]] double exposure_of(const Subject& subject, const BeforeAndAfter& measured) {
    if (subject.truth)
        return exposure_for(*subject.truth);
    std::vector<double> brightness; // of the smoothest picture
    for (const Rgb& pixel : measured.before.looks.back().picture.pixels)
        brightness.push_back(
            (static_cast<double>(pixel[0]) + static_cast<double>(pixel[1]) + static_cast<double>(pixel[2])) / 3);
    return exposure_for(std::move(brightness));
}

[[nodiscard]] Image<float> truth_of(const Subject& subject) {
    Image<float> picture(subject.width, subject.height);
    std::ranges::transform(*subject.truth, picture.pixels.begin(), [](double e) { return static_cast<float>(e); });
    return picture;
}

/// One photon in twenty pixels, on average, each a dot: darker where it is held more.
[[nodiscard]] Image<Rgb> dots(const std::vector<StoredPhoton>& photons, const FilmRectangle& floor,
                              const std::vector<float>& weights) {
    const double width = floor.x_max - floor.x_min, height = floor.y_max - floor.y_min;
    const auto is_inside = [&](const glm::vec3& p) {
        const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
        return x >= floor.x_min && x <= floor.x_max && y >= floor.y_min && y <= floor.y_max; // with its border's own
    };
    const auto inside = static_cast<double>(
        std::ranges::count_if(photons, [&](const StoredPhoton& photon) { return is_inside(photon.position); }));
    const double side =
        std::clamp(std::sqrt(20 * inside / (width * height)), 64 / width, 2048 / (std::max)(width, height));
    Image<Rgb> picture(static_cast<std::size_t>(std::ceil(side * width)),
                       static_cast<std::size_t>(std::ceil(side * height)), Rgb{1, 1, 1});
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const glm::vec3& p = photons[i].position;
        if (!is_inside(p))
            continue;
        const float weight = weights.empty() ? 0 : weights[i];
        const auto x = static_cast<std::size_t>((static_cast<double>(p.x) - floor.x_min) * side);
        const auto y = static_cast<std::size_t>((static_cast<double>(p.y) - floor.y_min) * side);
        picture((std::min)(x, picture.width - 1), (std::min)(y, picture.height - 1)) =
            weights.empty() ? Rgb{0, 0, 0} : Rgb{weight, 0.6f * (1 - weight), 0.6f * (1 - weight)};
    }
    return picture;
}

/// Frequency zero in the middle; four times white noise and more is white.
[[nodiscard]] Image<float> spectrum_picture(const PowerSpectrum& spectrum) {
    const auto highest = static_cast<std::int64_t>(spectrum.highest());
    Image<float> picture(2 * spectrum.highest() + 1, 2 * spectrum.highest() + 1);
    for (std::int64_t y = -highest; y <= highest; ++y)
        for (std::int64_t x = -highest; x <= highest; ++x)
            if (std::hypot(static_cast<double>(x), static_cast<double>(y)) >= BlueNoise::least_frequency())
                picture(static_cast<std::size_t>(x + highest), static_cast<std::size_t>(y + highest)) =
                    static_cast<float>(spectrum.power(x, y));
    return picture;
}

} // namespace

std::vector<Exhibit> write_pictures(const std::filesystem::path& folder, const Subject& subject,
                                    const BeforeAndAfter& measured) {
    const double exposure = exposure_of(subject, measured);
    std::vector<Exhibit> written;
    const auto write = [&](const std::string& name, const auto& picture, double own_exposure) {
        write_png(folder / (name + ".png"), picture, own_exposure);
        written.push_back({name, "", folder / (name + ".png"), {}});
    };
    for (const auto& [name, map] : {std::pair("before", &measured.before), std::pair("after", &measured.after)}) {
        for (const Look& look : map->looks)
            write(std::string(name) + "-" + std::to_string(look.neighbours), look.picture, exposure);
        if (map->blue_noise)
            write(std::string("spectrum-") + name, spectrum_picture(map->blue_noise->spectrum), 0.25);
    }
    if (subject.truth)
        write("truth", truth_of(subject), exposure);
    if (measured.before.best)
        write("before-best", measured.before.best->picture, exposure);
    if (!subject.floor)
        return written;
    write("dots-before", dots(subject.photons, *subject.floor, {}), 1);
    write("dots-after", dots(measured.relaxed, *subject.floor, {}), 1);
    if (!measured.weights.empty())
        write("features", dots(subject.photons, *subject.floor, measured.weights), 1);
    return written;
}

} // namespace nephroid::examples::study::relax
