// SPDX-License-Identifier: MIT
#include "common/study/spectrum/methods.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/sheet_caustics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::examples::study::spectrum {

namespace {

using Smoothing = std::optional<double>;

/// A spectral pass; to first order if the smoothing is given.
[[nodiscard]] Picture spectral(const Subject& subject, std::uint64_t walks, Smoothing smoothing, std::size_t parts,
                               ThreadExecutor& executor) {
    auto sums = nephroid::sums<Color>(subject.map);
    const Spectral light(sun(Color(1)), EqualBands<bands>{}, parts);
    const PhotonPass pass{.count = walks, .smoothing = smoothing};
    if (smoothing)
        (void)caustics(Water{}, light, sums, pass, Published{}, executor);
    else
        (void)caustics(Water{}, light, sums, pass, executor);
    Picture picture(subject.pixels.size());
    sums.for_each([&](std::size_t i, const Color& e) { picture[i] = e; });
    return picture;
}

/// Adds a pass of one wavelength to bands begin to end − 1.
void add_pass(const Subject& subject, double wavelength, std::uint64_t walks, double smoothing, std::size_t begin,
              std::size_t end, ThreadExecutor& executor, Picture& picture) {
    auto sums = nephroid::sums<float>(subject.map);
    (void)caustics(WaterAt{{}, wavelength}, sun(1.f), sums, {.count = walks, .smoothing = smoothing}, Published{},
                   executor);
    sums.for_each([&](std::size_t i, float e) {
        for (std::size_t b = begin; b < end; ++b)
            picture[i][b] = e;
    });
}

[[nodiscard]] Picture tangent(const Subject& subject, std::uint64_t walks, Smoothing smoothing,
                              ThreadExecutor& executor) {
    return spectral(subject, walks, smoothing, 1, executor);
}
[[nodiscard]] Picture each_its_own(const Subject& subject, std::uint64_t walks, Smoothing smoothing,
                                   ThreadExecutor& executor) {
    return spectral(subject, walks, smoothing, bands, executor);
}
[[nodiscard]] Picture all_wavelengths(const Subject& subject, std::uint64_t walks, Smoothing smoothing,
                                      ThreadExecutor& executor) {
    Picture picture(subject.pixels.size());
    for (std::size_t b = 0; b < bands; ++b)
        add_pass(subject, EqualBands<bands>{}.wavelength(double(b) + 0.5), walks / bands, smoothing.value(), b, b + 1,
                 executor, picture);
    return picture;
}
[[nodiscard]] Picture three_indices(const Subject& subject, std::uint64_t walks, Smoothing smoothing,
                                    ThreadExecutor& executor) {
    Picture picture(subject.pixels.size());
    constexpr std::array<std::size_t, 4> ends = {0, 5, 10, bands};
    for (std::size_t color = 0; color < 3; ++color)
        add_pass(subject, EqualBands<bands>{}.wavelength(0.5 * double(ends[color] + ends[color + 1])), walks / 3,
                 smoothing.value(), ends[color], ends[color + 1], executor, picture);
    return picture;
}
[[nodiscard]] Picture no_dispersion(const Subject& subject, std::uint64_t walks, Smoothing smoothing,
                                    ThreadExecutor& executor) {
    Picture picture(subject.pixels.size());
    add_pass(subject, 550, walks, smoothing.value(), 0, bands, executor, picture);
    return picture;
}

template <std::size_t Count>
[[nodiscard]] double error(const Picture& picture, const Picture& truth, const std::array<std::size_t, Count>& ends) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        for (std::size_t k = 0; k + 1 < Count; ++k) {
            double a = 0, b = 0;
            for (std::size_t band = ends[k]; band < ends[k + 1]; ++band) {
                a += double(picture[i][band]);
                b += double(truth[i][band]);
            }
            const double width = double(ends[k + 1] - ends[k]);
            squares += (a - b) * (a - b) / (width * width);
            sum += b / width;
        }
    const double n = double(truth.size() * (Count - 1));
    return std::sqrt(squares / n) / (sum / n);
}

} // namespace

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {{"tangent", false, tangent},
                                            {"tangent, second order", true, tangent},
                                            {"16 wavelengths", false, all_wavelengths},
                                            {"a wavelength per photon", false, each_its_own},
                                            {"three indices", false, three_indices},
                                            {"no dispersion", false, no_dispersion}};
    return all;
}

Picture truth(const Subject& subject, ThreadExecutor& executor) {
    constexpr std::size_t per_band = 3;
    const std::uint64_t photons = (std::max)(std::uint64_t(20'000), 4 * std::uint64_t(subject.pixels.size()));
    Picture picture(subject.pixels.size());
    for (std::size_t k = 0; k < per_band * bands; ++k) {
        const double wavelength = EqualBands<bands>{}.wavelength((double(k) + 0.5) / double(per_band));
        auto sums = nephroid::sums<float>(subject.map);
        (void)sheet_caustics(WaterAt{{}, wavelength}, sun(1.f), sums, {.count = photons}, {}, executor);
        sums.for_each([&](std::size_t i, float e) { picture[i][k / per_band] += e / float(per_band); });
    }
    return picture;
}

double error_in_bands(const Picture& picture, const Picture& truth) {
    std::array<std::size_t, bands + 1> ends{};
    for (std::size_t b = 0; b <= bands; ++b)
        ends[b] = b;
    return error(picture, truth, ends);
}

double error_in_three_colours(const Picture& picture, const Picture& truth) {
    return error(picture, truth, std::array<std::size_t, 4>{0, 5, 10, bands});
}

} // namespace nephroid::examples::study::spectrum
