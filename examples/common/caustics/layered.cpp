// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/image/room_exposure.hpp"

#include "nephroid/vector/glm.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace nephroid::examples {

Rendering render_layers(Options& options, const LayeredScene& seen, Report report, Stopwatch& total) {
    const auto& [scene, lamps, view, default_bounces] = seen;
    const Layer layer = options.layer;
    const unsigned bounces = options.bounces.value_or(layer == Layer::indirect ? all_bounces : default_bounces);
    const bool has_indirect = (layer == Layer::all || layer == Layer::indirect) && bounces > 0;
    const bool has_caustics = (layer == Layer::all || layer == Layer::caustics) && scene.has_specular();
    const auto fail = [&](const std::string& what) { throw std::runtime_error("'" + options.scene + "' " + what); };
    if (!has_caustics && !has_indirect && layer != Layer::direct && layer != Layer::indirect)
        fail("has no specular surface, so it has no caustic; add glass (KHR_materials_transmission) or a smooth metal, "
             "or ask for light between diffuse surfaces with --bounces all");

    if (!options.height_given)
        options.height = static_cast<std::size_t>((std::max)(1.0, std::round(double(options.width) / aspect_of(view))));
    const auto camera = camera_from<float>(view, options.width, options.height);
    ThreadExecutor threads(options.threads);
    report.threads = threads.threads();
    report.has_caustics = has_caustics;
    report.bounces = has_indirect ? bounces : 0;
    Stopwatch stopwatch;
    const FileEyePaths eye = see_file_scene(scene, lamps, camera, options, threads);
    report.eye_vertices = eye.vertices.size();
    report.seconds.eye_paths = stopwatch.lap();

    std::vector<RenderedLayer> layers, films;
    Image<glm::vec3> picture(options.width, options.height, glm::vec3(0));
    const auto add = [&](const std::string& name, FileLayer found) {
        for (std::size_t i = 0; i < found.pixels.size(); ++i)
            picture.pixels[i] += found.pixels[i];
        Image<glm::vec3> image;
        image.width = options.width;
        image.height = options.height;
        image.pixels = std::move(found.pixels);
        layers.push_back({name, Samples(image), std::move(found.variance)});
    };
    if (layer == Layer::all || layer == Layer::direct) {
        add("direct", {direct_layer_of(scene, lamps, eye, options, threads), {}, {}});
        report.seconds.direct = stopwatch.lap();
    }
    if (has_caustics || has_indirect) {
        using Vertex = EyeVertex<float, glm::vec3>;
        const bool are_sheets = has_caustics && options.method == Method::sheets;
        const FileMap map = are_sheets ? FileMap(eye.vertices, &Vertex::position, &Vertex::normal, &Vertex::footprint)
                                       : FileMap(eye.vertices, &Vertex::position, &Vertex::normal);
        report.seconds.map = stopwatch.lap();
        if (has_caustics && options.bands)
            add("caustics", spectral_layer_of(scene, lamps, eye, map, options, threads, report, films));
        else if (has_caustics)
            add("caustics", are_sheets ? sheet_layer_of(scene, lamps, eye, map, options, threads, report)
                                       : caustic_layer_of(scene, lamps, eye, map, options, threads, report));
        if (has_indirect && report.interrupted)
            report.note("interrupted before the light between diffuse surfaces");
        else if (has_indirect)
            add("indirect", indirect_layer_of(scene, lamps, eye, map, options, bounces, threads, report));
    }
    report.seconds.total = total.lap();
    for (RenderedLayer& film : films)
        layers.push_back(std::move(film));

    Samples samples(picture);
    const double exposure = room_exposure(samples);
    return {std::move(samples), exposure, std::move(report), std::move(layers)};
}

} // namespace nephroid::examples
