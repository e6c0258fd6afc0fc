// SPDX-License-Identifier: MIT
/// @file  An environment, which is light from infinitely far: constant, from a picture, or from a sun with a size.
#pragma once

#include "common/image/image.hpp"
#include "common/material.hpp"

#include "nephroid/emission/warp.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::examples {

/// Radiance by direction, and directions drawn approximately in proportion to it.
///
/// A picture is in longitude and latitude with y upwards. Its middle is the direction -z, in which a glTF camera looks
/// that is not rotated, and its right half is towards +x. Radiance between pixels is interpolated.
template <class T, Flux F>
class Environment {
public:
    /// A direction from which light comes.
    struct Direction {
        Vec3<T> towards; ///< unit, to where the light comes from
        T density;       ///< that it was drawn with, 1 / steradian, > 0
        F radiance;
    };

    /// @param radiance  >= 0, from every direction
    [[nodiscard]] static Environment constant(const F& radiance) {
        Environment e;
        e.radiance_ = radiance;
        e.total_ = flux_traits<F>::power(radiance) * 4 * pi<double>;
        return e;
    }

    /// @param direction   in which the light travels, unit
    /// @param irradiance  of a surface perpendicular to it
    /// @param diameter    of its disk, radians, in (0, pi)
    [[nodiscard]] static Environment sun(const Vec3<T>& direction, const F& irradiance, T diameter) {
        if (!(diameter > T(0) && diameter < pi<T>))
            invalid_argument("Environment: a sun's diameter must lie between 0 and pi");
        Environment e;
        e.towards_ = -direction;
        const double sine = std::sin(0.5 * double(diameter));
        e.height_ = 2 * std::pow(std::sin(0.25 * double(diameter)), 2); // 1 - cos, without cancellation
        e.radiance_ = irradiance * grey<F>(1 / (pi<double> * sine * sine));
        e.total_ = flux_traits<F>::power(e.radiance_) * 2 * pi<double> * e.height_;
        return e;
    }

    /// Throws std::invalid_argument for a picture that is empty, black, or has negative or infinite pixels.
    [[nodiscard]] static Environment picture(const Samples& image) {
        Environment e;
        e.read(image);
        e.tabulate();
        if (!(e.total_ > 0))
            invalid_argument("Environment: the picture is black");
        return e;
    }

    /// Whether it is a sun, which is too small for random directions and is sampled like a lamp.
    [[nodiscard]] bool is_lamp() const { return height_ < 2; }
    [[nodiscard]] bool is_constant() const { return columns_ == 0 && !is_lamp(); }

    [[nodiscard]] F radiance(const Vec3<T>& towards) const {
        if (columns_ > 0)
            return interpolated(towards);
        return is_lamp() && !(0.5 * double(length2(towards - towards_)) <= height_) ? flux_traits<F>::zero()
                                                                                    : radiance_;
    }

    /// @param u1,u2  0 to 1; the first is the longitude, or across a sun's disk
    [[nodiscard]] Direction sample(double u1, double u2) const {
        if (columns_ > 0)
            return sample_picture(u1, u2);
        if (!is_lamp()) {
            const Vec3<T> towards = on_sphere(2 * pi<double> * (u1 - 0.5), 1 - 2 * u2);
            return {towards, T(1 / (4 * pi<double>)), radiance_};
        }
        const DiskPoint<double> disk = concentric_disk(u1, u2);
        const double depth = height_ * (disk.x * disk.x + disk.y * disk.y), stretch = std::sqrt(height_ * (2 - depth));
        const Frame<Vec3<T>> frame = frame_about(towards_);
        return {
            normalize(Vec3<T>(T(stretch * disk.x) * frame.u + T(stretch * disk.y) * frame.v + T(1 - depth) * towards_)),
            T(1 / (2 * pi<double> * height_)), radiance_};
    }

    /// The density with which `sample` draws a direction, 1 / steradian.
    [[nodiscard]] double density(const Vec3<T>& towards) const {
        if (columns_ == 0)
            return 1 / (2 * pi<double> * height_);
        const PicturePoint at = picture_point(towards);
        const std::size_t x = index(at.x, columns_), y = index(at.y, rows_);
        return weights_[y * columns_ + x] / sum_ / solid_angle(y);
    }

    /// The integral of the radiance over all directions.
    [[nodiscard]] double total() const { return total_; }

private:
    /// A point of the picture, in pixels from its lower left corner.
    struct PicturePoint {
        double x, y;
    };

    [[nodiscard]] static Vec3<T> on_sphere(double longitude, double height) {
        const double across = std::sqrt((std::max)(0.0, (1 - height) * (1 + height)));
        return {T(across * std::sin(longitude)), T(height), T(-across * std::cos(longitude))};
    }

    [[nodiscard]] static std::size_t index(double place, std::size_t count) {
        return (std::min)(static_cast<std::size_t>((std::max)(0.0, place)), count - 1);
    }

    /// The sine of the latitude at a row's lower edge.
    [[nodiscard]] double lower_edge(std::size_t row) const {
        return -std::cos(pi<double> * double(row) / double(rows_));
    }
    [[nodiscard]] double solid_angle(std::size_t row) const {
        return 2 * pi<double> / double(columns_) * (lower_edge(row + 1) - lower_edge(row));
    }

    [[nodiscard]] PicturePoint picture_point(const Vec3<T>& towards) const {
        const double longitude = std::atan2(double(towards.x), -double(towards.z));
        const double latitude = std::asin((std::clamp)(double(towards.y), -1.0, 1.0));
        return {(0.5 + longitude / (2 * pi<double>)) * double(columns_), (0.5 + latitude / pi<double>)*double(rows_)};
    }

    [[nodiscard]] F interpolated(const Vec3<T>& towards) const {
        const PicturePoint at = picture_point(towards);
        const double x = at.x - 0.5, y = (std::clamp)(at.y - 0.5, 0.0, double(rows_ - 1));
        const double left = std::floor(x), down = std::floor(y);
        const auto pixel = [&](double column, double row) {
            const double wrapped = column < 0 ? column + double(columns_) : column;
            return pixels_[index(row, rows_) * columns_ + static_cast<std::size_t>(wrapped) % columns_];
        };
        const auto mix = [](const F& a, const F& b, double t) { return a * grey<F>(1 - t) + b * grey<F>(t); };
        return mix(mix(pixel(left, down), pixel(left + 1, down), x - left),
                   mix(pixel(left, down + 1), pixel(left + 1, down + 1), x - left), y - down);
    }

    [[nodiscard]] Direction sample_picture(double u1, double u2) const {
        const auto choose = [](auto first, auto last, double u, double& rest) {
            const double at = u * *(last - 1);
            const auto found = std::upper_bound(first, last - 1, at);
            const double before = found == first ? 0 : *(found - 1), share = *found - before;
            rest = share > 0 ? (std::clamp)((at - before) / share, 0.0, 1.0) : 0.5;
            return static_cast<std::size_t>(found - first);
        };
        double in_row = 0, in_column = 0;
        const std::size_t y = choose(rows_up_to_.begin(), rows_up_to_.end(), u2, in_row);
        const auto row = columns_up_to_.begin() + static_cast<std::ptrdiff_t>(y * columns_);
        const std::size_t x = choose(row, row + static_cast<std::ptrdiff_t>(columns_), u1, in_column);
        const double height = lower_edge(y) + in_row * (lower_edge(y + 1) - lower_edge(y));
        const double longitude = 2 * pi<double> * ((double(x) + in_column) / double(columns_) - 0.5);
        const Vec3<T> towards = on_sphere(longitude, height);
        return {towards, T(weights_[y * columns_ + x] / sum_ / solid_angle(y)), interpolated(towards)};
    }

    void read(const Samples& image) {
        columns_ = image.width, rows_ = image.height;
        if (columns_ == 0 || rows_ == 0)
            invalid_argument("Environment: the picture is empty");
        pixels_.reserve(columns_ * rows_);
        for (std::size_t i = 0; i < columns_ * rows_; ++i) {
            const float* s = image.samples.data() + i * image.channels;
            const Vec3<T> rgb = image.channels == 1 ? Vec3<T>(T(s[0])) : Vec3<T>(T(s[0]), T(s[1]), T(s[2]));
            for (int band = 0; band < 3; ++band)
                if (!(rgb[band] >= T(0)) || !std::isfinite(rgb[band]))
                    invalid_argument("Environment: the picture has a pixel that is negative or not finite");
            if constexpr (std::floating_point<F>)
                pixels_.push_back(static_cast<F>((rgb.x + rgb.y + rgb.z) / 3));
            else
                pixels_.push_back(F(rgb));
        }
    }

    /// Tabulates the density: pixels are drawn by the mean of the pixels around, because light is interpolated from
    /// these.
    void tabulate() {
        weights_.resize(columns_ * rows_);
        for (std::size_t y = 0; y < rows_; ++y)
            for (std::size_t x = 0; x < columns_; ++x) {
                double around = 0;
                for (std::size_t b = y == 0 ? 0 : y - 1; b < (std::min)(y + 2, rows_); ++b)
                    for (std::size_t a = 0; a < 3; ++a)
                        around += flux_traits<F>::power(pixels_[b * columns_ + (x + a + columns_ - 1) % columns_]);
                weights_[y * columns_ + x] = around / 9 * solid_angle(y);
                total_ += flux_traits<F>::power(pixels_[y * columns_ + x]) * solid_angle(y);
            }
        for (std::size_t y = 0; y < rows_; ++y) {
            double row = 0;
            for (std::size_t x = 0; x < columns_; ++x)
                columns_up_to_.push_back(row += weights_[y * columns_ + x]);
            rows_up_to_.push_back(sum_ += row);
        }
    }

    F radiance_ = flux_traits<F>::zero(); ///< of a constant environment or a sun
    Vec3<T> towards_{0, 1, 0};            ///< a sun's middle
    double height_ = 2;                   ///< of a sun's cone, 1 - cos of half its diameter; 2 is every direction
    double total_ = 0;
    std::size_t columns_ = 0, rows_ = 0; ///< of a picture
    std::vector<F> pixels_;
    std::vector<double> weights_, columns_up_to_, rows_up_to_;
    double sum_ = 0;
};

} // namespace nephroid::examples
