// SPDX-License-Identifier: MIT
/// @file  Path traces a caustic, a room or a file whose light has an area: a reference picture with its standard error.
#include "common/image/room_exposure.hpp"
#include "common/image/write.hpp"
#include "common/path_tracer/options.hpp"
#include "common/rooms.hpp"
#include "common/stopwatch.hpp"
#include "common/text.hpp"

#include <exception>
#include <iostream>
#include <limits>
#include <optional>

namespace nephroid::examples {

namespace {

[[nodiscard]] BuiltinCase<double, double> find_case(const std::string& name) {
    auto found = builtin_case<double, double>(name, false);
    if (!found)
        throw UsageError("'" + name + "' is none of the built-in cases " + traceable_names() + ", of the rooms " +
                         names_of_rooms() + ", and no .glb or .gltf file");
    if (found->emitters.empty())
        throw UsageError("the light of '" + name + "' has no area, no path from the floor meets it; try " +
                         traceable_names());
    return std::move(*found);
}

[[nodiscard]] Samples as_picture(const std::vector<double>& pixels, const PictureSize& size) {
    std::vector<float> samples;
    samples.reserve(pixels.size());
    for (const double pixel : pixels) // infinite after one pass, which tells nothing about the error
        samples.push_back(static_cast<float>((std::min)(pixel, double(std::numeric_limits<float>::max()))));
    return {size.width, size.height, 1, std::move(samples)};
}

/// The accuracy of a picture.
struct Certainty {
    double mean = 0;           ///< irradiance; of a room the radiance, as of its bands the mean
    double relative_error = 0; ///< mean of standard error over irradiance, where that is above a hundredth of its mean
    std::size_t lit = 0;       ///< pixels of those

    Certainty(const std::vector<double>& light, const std::vector<double>& error) {
        for (const double pixel : light)
            mean += pixel / double(light.size());
        for (std::size_t i = 0; i < light.size(); ++i)
            if (light[i] > 0.01 * mean) {
                relative_error += error[i] / light[i];
                ++lit;
            }
        relative_error /= double((std::max)(lit, std::size_t(1)));
    }

    /// @param paths,quantity  what they are called
    [[nodiscard]] std::string line(std::uint64_t samples, double seconds, const char* paths,
                                   const char* quantity) const {
        return grouped(samples) + text(" %s, %.1f s: mean %s %.6f, standard error %.2f%% of a lit pixel", paths,
                                       seconds, quantity, mean, 100 * relative_error);
    }
};

/// The mean of each pixel's bands.
[[nodiscard]] std::vector<double> power_of(const Samples& picture) {
    std::vector<double> power(picture.width * picture.height);
    for (std::size_t i = 0; i < picture.samples.size(); ++i)
        power[i / picture.channels] += double(picture.samples[i]) / double(picture.channels);
    return power;
}

/// A picture as it is written, and what is said of it.
struct Shown {
    Samples mean, standard_error;
    Certainty certainty;
    std::uint64_t samples;
    double exposure; ///< of both
};

[[nodiscard]] Shown shown(const PathTracedReference& traced, const PictureSize& size) {
    return {as_picture(traced.mean, size), as_picture(traced.standard_error, size),
            Certainty(traced.mean, traced.standard_error), traced.samples, 1};
}

[[nodiscard]] Shown shown(const RoomPicture& traced) {
    return {traced.mean, traced.standard_error, Certainty(power_of(traced.mean), power_of(traced.standard_error)),
            traced.samples, room_exposure(traced.mean)};
}

void write(const TraceRequest& request, const Shown& picture) {
    write_image(request.mean, picture.mean, picture.exposure);
    if (request.standard_error)
        write_image(*request.standard_error, picture.standard_error, picture.exposure);
}

void render(const TraceRequest& request) {
    const bool is_room = !request.room.scene.empty();
    const std::optional<BuiltinCase<double, double>> builtin =
        is_room ? std::nullopt : std::optional(find_case(request.scene));
    require_writable_image(request.mean);
    if (request.standard_error)
        require_writable_image(*request.standard_error);

    ThreadExecutor threads(request.threads);
    Stopwatch stopwatch;
    double seconds = 0, written = 0;
    const auto line = [&](const Shown& picture) {
        return is_room ? picture.certainty.line(picture.samples, seconds, "paths an eye path", "radiance")
                       : picture.certainty.line(picture.samples, seconds, "paths a pixel", "irradiance");
    };
    const auto snapshot = [&](const auto& show) {
        constexpr double interval = 20; // seconds
        seconds += stopwatch.lap();
        if (seconds - written >= interval) {
            const Shown so_far = show();
            write(request, so_far);
            std::cerr << line(so_far) << '\n';
            written = seconds;
        }
        return true;
    };
    const auto trace = [&] {
        if (is_room)
            return shown(path_trace_room(
                request.room, threads, [](const std::string& note) { std::cout << "note: " << note << '\n'; },
                [&](const RoomPicture& so_far) { return snapshot([&] { return shown(so_far); }); }));
        return shown(path_trace_reference(*builtin, request.size.width, request.size.height, request.tracing, threads,
                                          [&](const PathTracedReference& so_far) {
                                              return snapshot([&] { return shown(so_far, request.size); });
                                          }),
                     request.size);
    };
    const Shown picture = trace();
    write(request, picture);
    std::cout << request.scene << ", " << picture.mean.width << " x " << picture.mean.height << ", "
              << threads.threads() << " threads\n"
              << line(picture) << '\n'
              << "picture: " << request.mean.string() << '\n';
    if (request.standard_error)
        std::cout << "standard error: " << request.standard_error->string() << '\n';
}

} // namespace

} // namespace nephroid::examples

int main(int argc, char** argv) {
    using namespace nephroid::examples;
    try {
        if (const auto request = read_trace_request(argc, argv))
            render(*request);
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "reference_path_tracer: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "reference_path_tracer: " << error.what() << '\n';
        return 1;
    }
}
