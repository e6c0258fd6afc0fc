// SPDX-License-Identifier: MIT
/// @file  Renders a caustic, built-in or from a glTF file, by photon differential splatting and says how wrong it is.
#include "common/caustics/builtin.hpp"
#include "common/caustics/file_scene.hpp"
#include "common/caustics/interrupt.hpp"
#include "common/caustics/layers_file.hpp"
#include "common/image/file.hpp"
#include "common/image/pfm.hpp"
#include "common/image/png.hpp"
#include "common/image/write.hpp"
#include "common/rooms.hpp"
#include "common/scenes/scenes.hpp"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
    using namespace nephroid::examples;
    try {
        auto options = read_options(argc, argv);
        if (!options)
            return 0;
        note_interrupts();
        require_writable_image(options->output);
        if (options->layers)
            require_writable_image(*options->layers);
        if (options->json)
            require_writable(*options->json);

        std::optional<Samples> reference;
        if (options->reference)
            reference = read_pfm(*options->reference);
        Rendering rendering = is_builtin(options->scene)                            ? render_builtin(*options)
                              : is_room(options->scene) || is_scene(options->scene) ? render_room(*options)
                                                                                    : render_file(*options);
        if (reference)
            rendering.report.errors = errors_against(*reference, rendering.picture);
        write_image(options->output, rendering.picture, rendering.exposure);
        if (options->layers)
            write_layers(*options->layers, rendering);
        if (options->json)
            write_file(*options->json, json_text(*options, rendering.report));
        print_table(std::cout, *options, rendering.report);
        std::cout << "picture: " << options->output.string() << '\n';
        if (rendering.report.interrupted) {
            std::cerr << "caustics: interrupted; the picture has " << rendering.report.photons_emitted()
                      << " photons\n";
            return interrupted_status();
        }
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "caustics: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "caustics: " << error.what() << '\n';
        return 1;
    }
}
