// SPDX-License-Identifier: MIT
#include "common/study/relax/subject.hpp"

#include "common/builtin_film.hpp"
#include "common/study/relax/pattern.hpp"

#include <algorithm>
#include <variant>

namespace nephroid::examples::study::relax {

namespace {

constexpr double margin = 0.1; ///< of photons about a pattern's picture

[[nodiscard]] std::string lower_case_extension(const std::string& name) {
    std::string extension = std::filesystem::path(name).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

/// Draws photons from a density by rejection, until as many as wanted lie in the unit square.
template <SampleSequence Sequence>
[[nodiscard]] std::vector<StoredPhoton> draw(const Pattern& pattern, std::uint64_t wanted, const Sequence& sequence) {
    std::vector<StoredPhoton> photons;
    const Color flux(1 / static_cast<float>(wanted));
    std::uint64_t inside = 0;
    for (std::uint64_t i = 0; inside < wanted; ++i) {
        const double x = (1 + 2 * margin) * sequence.template sample<double>(i, 0) - margin;
        const double y = (1 + 2 * margin) * sequence.template sample<double>(i, 1) - margin;
        if (!(sequence.template sample<double>(i, 2) < pattern.density(x, y)))
            continue;
        photons.push_back({{static_cast<float>(x), static_cast<float>(y), 0}, {0, 0, 1}, {0, 0, -1}, flux});
        inside += x >= 0 && x < 1 && y >= 0 && y < 1;
    }
    return photons;
}

/// The pattern's irradiance, pixel by pixel, by 64 places in each, no two in the same row or column: edges along the
/// axes are resolved to a 64th of a pixel.
[[nodiscard]] std::vector<double> irradiance_of(const Pattern& pattern, std::size_t width, std::size_t height) {
    constexpr int places = 64, step = 23; // prime to it, and near the golden section of it
    std::vector<double> irradiance(width * height);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            double sum = 0;
            for (int i = 0; i < places; ++i) {
                const double across = (i + 0.5) / places, up = (i * step % places + 0.5) / places;
                sum += pattern.density((static_cast<double>(x) + across) / static_cast<double>(width),
                                       (static_cast<double>(y) + up) / static_cast<double>(height));
            }
            irradiance[y * width + x] = sum / (places * pattern.mean);
        }
    return irradiance;
}

} // namespace

Subject pattern_subject(const Options& options) {
    const Pattern pattern =
        is_pattern(options.subject) ? relax::pattern(options.subject) : guide_pattern(options.subject);
    Subject subject;
    subject.photons = std::visit([&](const auto& sequence) { return draw(pattern, options.photons, sequence); },
                                 make_sequence(options.sequence, options.seed));
    subject.width = options.width;
    subject.height = options.height;
    subject.floor = FilmRectangle{0, 1, 0, 1};
    subject.vertices = eye_vertices({.scene = options.subject,
                                     .view = *subject.floor,
                                     .width = options.width,
                                     .height = options.height,
                                     .samples = options.samples});
    if (pattern.onto_floor) {
        const auto back = [onto = pattern.onto_floor](const glm::vec3& moved) {
            const auto [x, y] = onto(static_cast<double>(moved.x), static_cast<double>(moved.y));
            return glm::vec3(static_cast<float>(x), static_cast<float>(y), 0);
        };
        subject.project = [back](std::size_t, const glm::vec3& moved) { return back(moved); };
        subject.on_surface = [back](const glm::vec3& place) { return back(place) == place; };
        std::erase_if(subject.vertices, [&](const auto& vertex) { return !subject.on_surface(vertex.position); });
    }
    subject.truth = irradiance_of(pattern, options.width, options.height);
    subject.edges = pattern.edges;
    if (options.subject == "uniform")
        subject.evenly_lit = {0, 1, 0, 1};
    return subject;
}

std::vector<EyeVertex<float, Color>> eye_vertices(const BuiltinFilm& film) {
    const std::vector<FloorVertex> floor = floor_vertices(film);
    const Color weight(1 / static_cast<float>(film.samples));
    std::vector<EyeVertex<float, Color>> vertices;
    vertices.reserve(floor.size());
    for (const FloorVertex& vertex : floor)
        vertices.push_back({vertex.position, upwards(vertex), upwards(vertex), 0, vertex.pixel, weight});
    return vertices;
}

Subject make_subject(const Options& options, ThreadExecutor& threads) {
    const std::string extension = lower_case_extension(options.subject);
    if (is_pattern(options.subject) || extension == ".png")
        return pattern_subject(options);
    if (is_builtin(options.subject))
        return builtin_subject(options, threads);
    if (extension == ".glb" || extension == ".gltf")
        return file_subject(options, threads);
    throw UsageError("'" + options.subject + "' is neither a pattern (" + pattern_names() + "), a built-in case (" +
                     builtin_names() + ") nor a .png, .glb or .gltf file");
}

} // namespace nephroid::examples::study::relax
