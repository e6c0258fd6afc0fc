// SPDX-License-Identifier: MIT
#include "common/study/relax/pattern.hpp"

#include "common/image/read_png.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace nephroid::examples::study::relax {

namespace {

constexpr std::array names = {"uniform", "ellipse-and-bars", "soft-disc", "sines", "l-shape"};

struct Ellipse {
    double x, y; ///< centre
    double half_width, half_height;

    [[nodiscard]] bool holds(double px, double py) const {
        return std::hypot((px - x) / half_width, (py - y) / half_height) < 1;
    }
    [[nodiscard]] double area() const { return std::numbers::pi * half_width * half_height; }

    /// Places around it, evenly by the parameter.
    [[nodiscard]] std::vector<Edge::Place> places(int count) const {
        std::vector<Edge::Place> places;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * i / count, c = std::cos(angle), s = std::sin(angle);
            const double length = std::hypot(c / half_width, s / half_height);
            places.push_back(
                {{x + half_width * c, y + half_height * s}, {-c / half_width / length, -s / half_height / length}});
        }
        return places;
    }
};

struct Bar {
    double left, right, low, high;

    [[nodiscard]] bool holds(double x, double y) const { return x > left && x < right && y > low && y < high; }
    [[nodiscard]] double area() const { return (right - left) * (high - low); }

    /// Of its two long sides, a tenth of their length away from the ends.
    [[nodiscard]] std::vector<Edge::Place> places(int count) const {
        std::vector<Edge::Place> places;
        for (int i = 0; i < count; ++i) {
            const double y = low + (high - low) * (0.1 + 0.8 * (i + 0.5) / count);
            places.push_back({{left, y}, {1, 0}});
            places.push_back({{right, y}, {-1, 0}});
        }
        return places;
    }
};

constexpr Ellipse ellipse{0.3, 0.5, 0.16, 0.28};
constexpr std::array bars = {Bar{0.58, 0.66, 0.15, 0.85}, Bar{0.78, 0.86, 0.15, 0.85}};

[[nodiscard]] Pattern ellipse_and_bars() {
    const auto is_bright = [](double x, double y) {
        return ellipse.holds(x, y) || bars[0].holds(x, y) || bars[1].holds(x, y);
    };
    const double bright = ellipse.area() + bars[0].area() + bars[1].area(), mean = 0.1 + 0.9 * bright;
    std::vector<Edge::Place> places = bars[0].places(60);
    const auto more = bars[1].places(60);
    places.insert(places.end(), more.begin(), more.end());
    return {
        [is_bright](double x, double y) { return is_bright(x, y) ? 1 : 0.1; },
        mean,
        {{"bars", 0.1 / mean, 1 / mean, std::move(places)}, {"ellipse", 0.1 / mean, 1 / mean, ellipse.places(240)}}};
}

/// A bright disc without an edge.
[[nodiscard]] double soft_disc(double x, double y) {
    return 0.15 + 0.85 / (1 + std::exp((std::hypot(x - 0.5, y - 0.5) - 0.25) / 0.03));
}

/// Waves along both axes: 1/2 on average over the unit square, which holds three of each.
[[nodiscard]] double sines(double x, double y) {
    return 0.5 + 0.4 * std::sin(6 * std::numbers::pi * x) * std::sin(6 * std::numbers::pi * y);
}

/// The nearest place of the unit square without its upper right quarter.
[[nodiscard]] std::array<double, 2> onto_l_shape(double x, double y) {
    x = std::clamp(x, 0.0, 1.0), y = std::clamp(y, 0.0, 1.0);
    if (x <= 0.5 || y <= 0.5)
        return {x, y};
    return x < y ? std::array{0.5, y} : std::array{x, 0.5};
}

[[nodiscard]] double l_shape(double x, double y) { return onto_l_shape(x, y) == std::array{x, y} ? 1 : 0; }

/// Of the unit square, by its 512² midpoints.
[[nodiscard]] double mean_of(double (*density)(double, double)) {
    constexpr int side = 512;
    double sum = 0;
    for (int i = 0; i < side * side; ++i)
        sum += density((i % side + 0.5) / side, (i / side + 0.5) / side);
    return sum / (side * side);
}

} // namespace

std::string pattern_names() {
    std::string text;
    for (const char* name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

bool is_pattern(const std::string& name) { return std::ranges::find(names, name) != names.end(); }

Pattern pattern(const std::string& name) {
    if (name == names[1])
        return ellipse_and_bars();
    if (name == names[2])
        return {soft_disc, mean_of(soft_disc), {}};
    if (name == names[3])
        return {sines, 0.5, {}};
    if (name == names[4])
        return {l_shape, 0.75, {}, onto_l_shape};
    return {[](double, double) { return 1.0; }, 1, {}};
}

Pattern guide_pattern(const std::filesystem::path& png) {
    Image<float> picture = brightness(read_png(png));
    const float brightest = std::ranges::max(picture.pixels);
    if (!(brightest > 0))
        throw std::runtime_error("'" + png.string() + "' is black, so no photon can be drawn from it");
    double sum = 0;
    for (float& pixel : picture.pixels)
        sum += static_cast<double>(pixel /= brightest);
    const double mean = sum / static_cast<double>(picture.pixels.size());
    const auto density = [picture = std::move(picture)](double x, double y) {
        const auto nearest = [](double place, std::size_t count) {
            return static_cast<std::size_t>(
                std::clamp(std::floor(place * static_cast<double>(count)), 0.0, static_cast<double>(count - 1)));
        };
        return static_cast<double>(picture(nearest(x, picture.width), nearest(y, picture.height)));
    };
    return {density, mean, {}};
}

} // namespace nephroid::examples::study::relax
