// SPDX-License-Identifier: MIT
#include "common/study/compare/pictures.hpp"

#include "common/image/png.hpp"
#include "common/study/bench.hpp"
#include "common/text.hpp"

#include "nephroid/quality/exposure.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study::compare {

namespace {

constexpr std::size_t crop_side = 128;
constexpr std::array shown = {Measure::rmse, Measure::ssim};

[[nodiscard]] double contrast(const std::vector<double>& seen, std::size_t width, const Crop& crop) {
    double sum = 0, square = 0;
    for (std::size_t y = crop.y; y < crop.y + crop.side; ++y)
        for (std::size_t x = crop.x; x < crop.x + crop.side; ++x) {
            const double pixel = seen[y * width + x];
            sum += pixel;
            square += pixel * pixel;
        }
    const double count = double(crop.side) * double(crop.side);
    return square / count - (sum / count) * (sum / count);
}

/// Pastes a picture of the same number of channels.
void paste(Samples& canvas, const Samples& picture, std::size_t x, std::size_t y) {
    for (std::size_t row = 0; row < picture.height; ++row)
        for (std::size_t column = 0; column < picture.width; ++column)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const std::size_t from = (row * picture.width + column) * picture.channels;
                canvas.samples[((y + row) * canvas.width + x + column) * 3 + channel] =
                    picture.samples[from + (picture.channels == 3 ? channel : 0)];
            }
}

/// Two rows of pictures: those of the methods, and the differences below.
class StripCanvas {
public:
    StripCanvas(std::size_t count, std::size_t side)
        : side_(side), canvas_(count * (side + gap) - gap, 2 * side + gap, 3, {}) {
        canvas_.samples.assign(canvas_.width * canvas_.height * 3, 1.f);
    }
    void picture(std::size_t place, Samples picture, double exposure) {
        for (float& sample : picture.samples)
            sample = static_cast<float>(std::clamp(exposure * double(sample), 0.0, 1.0));
        paste(canvas_, picture, place * (side_ + gap), side_ + gap);
    }
    void difference(std::size_t place, const Samples& difference) {
        paste(canvas_, difference, place * (side_ + gap), 0);
    }
    [[nodiscard]] const Samples& canvas() const { return canvas_; }

private:
    static constexpr std::size_t gap = 4;
    std::size_t side_;
    Samples canvas_;
};

[[nodiscard]] std::string stem(const Trial& trial, Measure measure) {
    return trial.method->id + "-" + name_of(trial.sequence) + "-" + std::to_string(trial.wanted) + "-" +
           name_of(measure);
}

[[nodiscard]] Exhibit exhibit(const std::filesystem::path& folder, const Bench& bench, const Trial& trial,
                              Measure measure, const Crop& crop) {
    const Best& best = trial.by(measure);
    const std::string note =
        bandwidth_text(*best.method, best.bandwidth) +
        text(", RMSE %.4f, SSIM %.4f, %.3f s", best.errors.rmse, best.errors.ssim, best.timing.seconds.total());
    const Exhibit made{trial.method->title, note, folder / (stem(trial, measure) + "-crop.png"),
                       folder / (stem(trial, measure) + "-difference.png")};
    write_png(made.picture, cropped(bench, best.irradiance, crop), bench.exposure());
    write_png(made.difference, difference(bench, best.irradiance, crop));
    return made;
}

} // namespace

Crop busiest_crop(const Bench& bench, std::size_t side) {
    const BuiltinFilm& film = bench.film();
    side = (std::min)({side, film.width, film.height});
    const std::vector<double> seen = exposed(bench.reference(), bench.exposure());
    const std::size_t step = (std::max)(std::size_t(1), side / 8);
    Crop best{0, 0, side};
    double most = -1;
    for (std::size_t y = 0; y + side <= film.height; y += step)
        for (std::size_t x = 0; x + side <= film.width; x += step)
            if (const double c = contrast(seen, film.width, {x, y, side}); c > most) {
                most = c;
                best = {x, y, side};
            }
    return best;
}

Samples cropped(const Bench& bench, const std::vector<float>& irradiance, const Crop& crop) {
    std::vector<float> pixels;
    for (std::size_t y = crop.y; y < crop.y + crop.side; ++y)
        for (std::size_t x = crop.x; x < crop.x + crop.side; ++x)
            pixels.push_back(irradiance[y * bench.film().width + x]);
    return {crop.side, crop.side, 1, std::move(pixels)};
}

Samples difference(const Bench& bench, const std::vector<float>& irradiance, const Crop& crop) {
    const auto seen = [&](double pixel) { return std::clamp(pixel * bench.exposure(), 0.0, 1.0); };
    std::vector<float> pixels;
    for (std::size_t y = crop.y; y < crop.y + crop.side; ++y)
        for (std::size_t x = crop.x; x < crop.x + crop.side; ++x) {
            const std::size_t pixel = y * bench.film().width + x;
            const double excess = 4 * (seen(double(irradiance[pixel])) - seen(bench.reference()[pixel]));
            const double white = (std::max)(0.0, std::abs(excess) - 1); // beyond full colour, towards white
            for (const double colour : {(std::max)(excess, white), white, (std::max)(-excess, white)})
                pixels.push_back(static_cast<float>((std::min)(1.0, colour)));
        }
    return {crop.side, crop.side, 3, std::move(pixels)};
}

std::filesystem::path picture_path(const std::filesystem::path& folder, const Trial& trial, Measure measure) {
    return folder / (stem(trial, measure) + ".png");
}

void write_pictures(const std::filesystem::path& folder, const Bench& bench, const Trial& trial) {
    for (const Measure measure : shown)
        write_png(picture_path(folder, trial, measure),
                  {bench.film().width, bench.film().height, 1, trial.by(measure).irradiance}, bench.exposure());
}

std::vector<Strip> write_strips(const std::filesystem::path& folder, const Options& options, const Bench& bench,
                                const std::vector<Trial>& trials) {
    const Crop crop = busiest_crop(bench, crop_side);
    const std::vector<float> reference(bench.reference().begin(), bench.reference().end());
    const std::filesystem::path reference_crop = folder / "reference-crop.png";
    write_png(reference_crop, cropped(bench, reference, crop), bench.exposure());

    std::vector<Strip> strips;
    for (const SequenceKind sequence : options.sequences)
        for (const Measure measure : shown) {
            Strip strip{grouped(target_photons(options)) + " " + name_of(sequence) + " photons, best " +
                            name_of(measure),
                        {{"reference", bench.is_exact() ? "exact" : "path traced", reference_crop, {}}}};
            StripCanvas canvas(options.methods.size() + 1, crop.side);
            canvas.picture(0, cropped(bench, reference, crop), bench.exposure());
            for (const Trial& trial : trials) {
                const std::vector<float>& irradiance = trial.by(measure).irradiance;
                if (trial.sequence != sequence || trial.wanted != target_photons(options))
                    continue;
                canvas.picture(strip.exhibits.size(), cropped(bench, irradiance, crop), bench.exposure());
                canvas.difference(strip.exhibits.size(), difference(bench, irradiance, crop));
                strip.exhibits.push_back(exhibit(folder, bench, trial, measure, crop));
            }
            write_png(folder / (std::string("strip-") + name_of(sequence) + "-" + name_of(measure) + ".png"),
                      canvas.canvas());
            strips.push_back(std::move(strip));
        }
    return strips;
}

} // namespace nephroid::examples::study::compare
