// SPDX-License-Identifier: MIT
#include "common/path_tracer/layers.hpp"

#include "common/rooms.hpp"
#include "examples/room_points.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace nephroid::examples::layers_test {

using namespace nephroid::examples::testing;

namespace {

using Color = Vec3<double>;
using Vertices = std::vector<EyeVertex<double, Color>>;

/// Four pixels of the box's floor, of four vertices each; between the second and the third one without any.
[[nodiscard]] Vertices floor_pixels() {
    Vertices vertices;
    for (const std::uint32_t pixel : {0u, 1u, 3u, 4u})
        add_wall<double, Color>(vertices, {0.2 * pixel, 0, 0.3}, {0, 0, 0.2}, {0.2, 0, 0}, 2, pixel);
    return vertices;
}

[[nodiscard]] std::string message_of(const Vertices& vertices, std::size_t pixels, std::uint64_t samples) {
    const auto room = built_in_room<double>("box").value();
    SerialExecutor serial;
    try {
        static_cast<void>(path_trace_layers(room.scene, room.lamps, vertices, pixels, {.samples = samples}, serial));
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST_CASE("layers: the picture is the same for any number of threads, and in rounds") {
    const auto room = built_in_room<double>("box").value();
    const Vertices vertices = floor_pixels();
    const LayerTraceOptions options{.samples = 40, .seed = 3};
    SerialExecutor serial;
    ThreadExecutor threads(3);
    const auto once = path_trace_layers(room.scene, room.lamps, vertices, 5, options, serial);
    std::vector<std::uint64_t> told;
    const auto again =
        path_trace_layers(room.scene, room.lamps, vertices, 5, options, threads, [&](const auto& so_far) {
            told.push_back(so_far.samples);
            return true;
        });
    CHECK(once.mean == again.mean);
    CHECK(once.standard_error == again.standard_error);
    CHECK(told == std::vector<std::uint64_t>{16, 32, 40});
    CHECK(once.samples == 40);
    REQUIRE(once.mean.size() == 5);
    CHECK(once.mean[2] == LightLayers<Color>{}); // no vertices
    CHECK(once.mean[0].indirect.x > 0);

    const auto stopped =
        path_trace_layers(room.scene, room.lamps, vertices, 5, options, serial, [](const auto&) { return false; });
    CHECK(stopped.samples == 16);
    LayerTraceOptions hurried = options;
    hurried.seconds = 0;
    CHECK(path_trace_layers(room.scene, room.lamps, vertices, 5, hurried, serial).samples == 16);
}

// Of 150 pictures with other numbers the spread is known to 1/sqrt(300) = 6%: four of those. An error of the errors
// themselves, which are means of 150, is smaller.
TEST_CASE("layers: the standard error is how much pictures with other random numbers differ") {
    const auto room = built_in_room<double>("box").value();
    const Vertices vertices = floor_pixels();
    SerialExecutor serial;
    constexpr int pictures = 150;
    for (const bool indirect : {false, true}) {
        double sum = 0, squares = 0, said = 0;
        for (int i = 0; i < pictures; ++i) {
            const auto found = path_trace_layers(room.scene, room.lamps, vertices, 5,
                                                 {.samples = 16, .seed = std::uint64_t(i)}, serial);
            const double value = indirect ? found.mean[1].indirect.y : found.mean[1].direct.y;
            const double error = indirect ? found.standard_error[1].indirect.y : found.standard_error[1].direct.y;
            sum += value, squares += value * value, said += error * error;
        }
        const double variance = (squares - sum * sum / pictures) / (pictures - 1);
        CAPTURE(variance);
        CHECK(std::sqrt(pictures * variance / said) == doctest::Approx(1).epsilon(0.24));
    }
}

TEST_CASE("layers: the error of the sum counts that layers of one path go together") {
    const auto room = built_in_room<double>("cornell").value();
    SerialExecutor serial;
    const auto found = path_trace_layers(room.scene, room.lamps, floor_pixels(), 5, {.samples = 64}, serial);
    for (const std::size_t pixel : {0u, 1u, 3u, 4u}) {
        const auto& e = found.standard_error[pixel];
        for (int band = 0; band < 3; ++band) {
            CHECK(found.sum_error[pixel][band] <= e.direct[band] + e.caustic[band] + e.indirect[band]);
            CHECK(found.sum_error[pixel][band] > 0.5 * e.indirect[band]);
        }
    }
}

// Both estimate the same integral, one by stratified rays to the lamp, the other by rays to it and by the cosine.
TEST_CASE("layers: direct light is what the direct layer of a picture has") {
    const auto room = built_in_room<double>("table").value();
    const auto camera = camera_from<double>(room.camera, 12, 9);
    SerialExecutor serial;
    const auto eye = trace_eye_paths(room.scene, camera, {.samples = 1}, serial);
    const auto traced =
        path_trace_layers(room.scene, room.lamps, eye.vertices, 12 * 9, {.samples = 160, .bounces = 0}, serial);
    const auto direct = direct_layer(room.scene, room.lamps, eye, {.shadow_rays = 1024}, serial);
    double difference = 0, variance = 0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
        CHECK(traced.mean[i].indirect == Color(0));
        difference += traced.mean[i].direct.x - (direct[i] - eye.emitted[i]).x;
        variance += square(traced.standard_error[i].direct.x);
    }
    CAPTURE(difference);
    CHECK(variance > 0);
    CHECK(std::abs(difference) < 4 * std::sqrt(variance)); // of 1024 stratified rays it is a thirtieth of that
}

TEST_CASE("layers: vertices out of order and a single sample are refused") {
    Vertices vertices = floor_pixels();
    CHECK(message_of(vertices, 5, 2) == "accepted");
    CHECK(message_of(vertices, 4, 2).find("order") != std::string::npos);
    CHECK(message_of(vertices, 5, 1).find("2 samples") != std::string::npos);
    std::swap(vertices.front(), vertices.back());
    CHECK(message_of(vertices, 5, 2).find("order") != std::string::npos);
    CHECK(message_of({}, 0, 2) == "accepted");
}

} // namespace nephroid::examples::layers_test
