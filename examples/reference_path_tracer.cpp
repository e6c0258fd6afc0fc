// SPDX-License-Identifier: MIT
/// @file  Path traces a built-in case whose light has an area: a reference picture with its standard error.
#include "common/command_line.hpp"
#include "common/image/write.hpp"
#include "common/path_tracer/path_tracer.hpp"
#include "common/stopwatch.hpp"
#include "common/text.hpp"

#include <CLI/CLI.hpp>

#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>

namespace nephroid::examples {

namespace {

struct Request {
    std::string scene;
    PictureSize size{};
    PathTraceOptions tracing;
    unsigned threads = 0;
    std::filesystem::path mean;
    std::optional<std::filesystem::path> standard_error;
};

/// The built-in cases whose light paths can hit.
[[nodiscard]] std::string traceable_names() {
    std::string names;
    for (const std::string_view name : builtin_case_names)
        if (!builtin_case<double, double>(name, false)->emitters.empty())
            names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

[[nodiscard]] BuiltinCase<double, double> find_case(const std::string& name) {
    auto found = builtin_case<double, double>(name, false);
    if (!found)
        throw UsageError("'" + name + "' is none of the built-in cases " + traceable_names());
    if (found->emitters.empty())
        throw UsageError("the light of '" + name + "' has no area, no path from the floor meets it; try " +
                         traceable_names());
    return std::move(*found);
}

/// @return  nothing if the command line asked for help
[[nodiscard]] std::optional<Request> read_request(int argc, const char* const* argv) {
    Request request;
    std::string size = "256", samples = "4096", seed = "0", output, standard_error, reflections = "any";
    CLI::App app("Path traces a caustic by a light that has area, with a standard error for each pixel.",
                 "reference_path_tracer");
    app.add_option("case", request.scene, "A built-in case whose light has area: " + traceable_names())->required();
    app.add_option("--size", size, "Pixels: 512x256, or a width that is the height as well [256]");
    app.add_option("--samples", samples, "Paths from each pixel [4096]");
    app.add_option("--seconds", request.tracing.seconds, "Begin no further pass after these [no limit]");
    app.add_option("--reflections", reflections, "one|any: leave out what would be reflected twice [any]");
    app.add_option("--seed", seed, "Of the random numbers [0]");
    app.add_option("--threads", request.threads, "0 takes all that the machine has [0]; the picture is the same");
    app.add_option("--output", output, "The picture, .pfm, .exr or .png [the case's name, .pfm]");
    app.add_option("--standard-error", standard_error, "A file for the standard error of each pixel");
    if (!parse(app, argc, argv))
        return std::nullopt;

    request.size = picture_size(size);
    request.tracing.samples = whole_number("--samples", samples, 1);
    request.tracing.seed = whole_number("--seed", seed, 0);
    if (!(request.tracing.seconds >= 0))
        throw UsageError("--seconds: " + text("%g", request.tracing.seconds) + " is not a number from 0 up");
    if (chosen("--reflections", reflections, Names<bool>{{"one", true}, {"any", false}}))
        request.tracing.specular_events = 1;
    check_threads(request.threads);
    request.mean = output.empty() ? request.scene + ".pfm" : output;
    if (!standard_error.empty())
        request.standard_error = standard_error;
    return request;
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
    double mean = 0;           ///< irradiance
    double relative_error = 0; ///< mean of standard error over irradiance, where that is above a hundredth of its mean
    std::size_t lit = 0;       ///< pixels of those

    explicit Certainty(const PathTracedReference& picture) {
        for (const double irradiance : picture.mean)
            mean += irradiance / double(picture.mean.size());
        for (std::size_t i = 0; i < picture.mean.size(); ++i)
            if (picture.mean[i] > 0.01 * mean) {
                relative_error += picture.standard_error[i] / picture.mean[i];
                ++lit;
            }
        relative_error /= double((std::max)(lit, std::size_t(1)));
    }

    [[nodiscard]] std::string line(std::uint64_t samples, double seconds) const {
        return grouped(samples) +
               text(" paths a pixel, %.1f s: mean irradiance %.6f, standard error %.2f%% of a lit pixel", seconds, mean,
                    100 * relative_error);
    }
};

void write(const Request& request, const PathTracedReference& picture) {
    write_image(request.mean, as_picture(picture.mean, request.size));
    if (request.standard_error)
        write_image(*request.standard_error, as_picture(picture.standard_error, request.size));
}

void render(const Request& request) {
    const BuiltinCase<double, double> builtin = find_case(request.scene);
    require_writable_image(request.mean);
    if (request.standard_error)
        require_writable_image(*request.standard_error);

    ThreadExecutor threads(request.threads);
    Stopwatch stopwatch;
    double seconds = 0, written = 0;
    const auto snapshot = [&](const PathTracedReference& so_far) {
        constexpr double interval = 20; // seconds
        seconds += stopwatch.lap();
        if (seconds - written >= interval) {
            write(request, so_far);
            std::cerr << Certainty(so_far).line(so_far.samples, seconds) << '\n';
            written = seconds;
        }
        return true;
    };
    const PathTracedReference picture =
        path_trace_reference(builtin, request.size.width, request.size.height, request.tracing, threads, snapshot);
    write(request, picture);
    std::cout << request.scene << ", " << request.size.width << " x " << request.size.height << ", "
              << threads.threads() << " threads\n"
              << Certainty(picture).line(picture.samples, seconds) << '\n'
              << "picture: " << request.mean.string() << '\n';
    if (request.standard_error)
        std::cout << "standard error: " << request.standard_error->string() << '\n';
}

} // namespace

} // namespace nephroid::examples

int main(int argc, char** argv) {
    using namespace nephroid::examples;
    try {
        if (const auto request = read_request(argc, argv))
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
