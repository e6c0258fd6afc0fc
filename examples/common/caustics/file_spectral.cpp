// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/caustics/render.hpp"
#include "common/photon_lights.hpp"
#include "common/spectral_view.hpp"

#include "nephroid/vector/glm.hpp"

#include <cmath>
#include <memory>
#include <string>

namespace nephroid::examples {

namespace {

constexpr std::size_t bands = Options::most_bands;

/// A film for each band: what is seen of it as grey.
void add_band_films(const Sums<glm::vec3, Bands<float, bands>>& sums, const FileEyePaths& eye, const Options& options,
                    const EqualBands<bands>& spectrum, std::vector<RenderedLayer>& films) {
    std::vector<std::vector<float>> pixels(bands, std::vector<float>(options.width * options.height, 0.f));
    sums.for_each([&](std::size_t vertex, const Bands<float, bands>& irradiance) {
        const auto& seen = eye.vertices[vertex];
        for (std::size_t b = 0; b < bands; ++b)
            pixels[b][seen.pixel] += irradiance[b] * float(flux_traits<glm::vec3>::power(seen.weight));
    });
    films.clear();
    for (std::size_t b = 0; b < bands; ++b)
        films.push_back({"caustics." + std::to_string(std::lround(spectrum.wavelength(double(b) + 0.5))) + "nm",
                         Samples(options.width, options.height, 1, std::move(pixels[b])),
                         {}});
}

} // namespace

FileLayer spectral_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const FileMap& map,
                            const Options& options, ThreadExecutor& threads, Report& report,
                            std::vector<RenderedLayer>& films) {
    const EqualBands<bands> spectrum{};
    const auto colors = std::make_shared<const SpectralColor<bands>>(spectrum);
    const SpectralView<bands> view(scene, *colors);
    auto lights = photon_lights(lamps, scene);
    const Spectral light(InBands<decltype(lights), bands>(std::move(lights), colors), spectrum);
    return splat_caustics_timed<Bands<float, bands>>(
        view, light, map, WalkLimits{}, options, false, threads, report, [&](const auto& sums) {
            std::vector<glm::vec3> pixels(options.width * options.height, glm::vec3(0));
            sums.for_each([&](std::size_t vertex, const Bands<float, bands>& irradiance) {
                pixels[eye.vertices[vertex].pixel] += colors->color_of(irradiance) * eye.vertices[vertex].weight;
            });
            for (glm::vec3& pixel : pixels)
                pixel = within_srgb(pixel);
            if (options.layers)
                add_band_films(sums, eye, options, spectrum, films);
            return pixels;
        });
}

} // namespace nephroid::examples
