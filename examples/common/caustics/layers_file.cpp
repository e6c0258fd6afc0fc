// SPDX-License-Identifier: MIT
#include "common/caustics/layers_file.hpp"

#include "common/image/exr.hpp"

#include <vector>

namespace nephroid::examples {

void write_layers(const std::filesystem::path& path, const Rendering& rendering) {
    const Samples& whole = rendering.picture;
    std::vector<ExrLayer> layers{{"", whole}};
    for (const RenderedLayer& layer : rendering.layers) {
        layers.push_back({layer.name, layer.picture});
        if (!layer.variance.empty())
            layers.push_back({layer.name + ".variance", Samples(whole.width, whole.height, 1, layer.variance)});
    }
    write_exr_layers(path, layers);
}

} // namespace nephroid::examples
