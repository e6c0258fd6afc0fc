// SPDX-License-Identifier: MIT
/// @file  Raster charts that are projections: of a plane, from a lamp, from the camera.
#pragma once

#include "nephroid/image/raster_chart.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/frame.hpp"
#include "nephroid/vector/text.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace nephroid {

namespace detail {
/// x = (row_x · d + offset_x) / w, y likewise, with d from the origin; w = row_w · d + offset_w; depth = row_z · d.
class ProjectedChart {
public:
    static constexpr bool lies_on_receiver = false;

    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::size_t rows() const { return rows_; }

    [[nodiscard]] std::optional<RasterPlace> place(const ChartVector& point) const {
        const ChartVector d = point - origin_;
        if (!is_perspective_) // w = 1, and four divisions less
            return RasterPlace{dot(row_x_, d) + offset_x_, dot(row_y_, d) + offset_y_, row_x_, row_y_, dot(row_z_, d)};
        const double w = dot(row_w_, d) + offset_w_;
        if (!(w > 0))
            return std::nullopt;
        const double x = (dot(row_x_, d) + offset_x_) / w, y = (dot(row_y_, d) + offset_y_) / w;
        return RasterPlace{x, y, (1 / w) * (row_x_ - x * row_w_), (1 / w) * (row_y_ - y * row_w_), dot(row_z_, d)};
    }

    [[nodiscard]] RasterRay ray(double x, double y) const {
        const ChartVector step = (x - middle_x_) * across_ + (y - middle_y_) * along_;
        if (is_perspective_)
            return {origin_, unit_or_zero(ahead_ + step)};
        return {start_ + step, ahead_};
    }

    /// Takes (x, y, z, 1) to (x w, y w, depth, w) in texels, row by row: what a shader needs to look the raster up.
    [[nodiscard]] std::array<double, 16> matrix() const {
        std::array<double, 16> m{};
        const auto row = [&](std::size_t i, const ChartVector& r, double offset) {
            m[4 * i] = r.x, m[4 * i + 1] = r.y, m[4 * i + 2] = r.z, m[4 * i + 3] = offset - dot(r, origin_);
        };
        row(0, row_x_, offset_x_), row(1, row_y_, offset_y_), row(2, row_z_, 0), row(3, row_w_, offset_w_);
        return m;
    }

protected:
    ProjectedChart(std::size_t columns, std::size_t rows, const char* name) : columns_(columns), rows_(rows) {
        const std::size_t most = 65536;
        if (columns == 0 || rows == 0 || columns > most || rows > most)
            invalid_argument(std::string("nephroid::") + name + ": " + std::to_string(columns) + " columns and " +
                             std::to_string(rows) + " rows; it needs 1 to 65536 of each");
    }

    static void require(bool valid, const char* name, const char* what, const std::string& value) {
        if (!valid)
            invalid_argument(std::string("nephroid::") + name + ": " + what + " is " + value +
                             "; it must be finite and not degenerate");
    }

    /// A parallelogram: texels are its columns-th and rows-th parts. `ahead` is the direction of sight, unit.
    void set_parallel(const ChartVector& corner, const ChartVector& edge_u, const ChartVector& edge_v,
                      const ChartVector& ahead) {
        // The dual basis in the plane across `ahead`.
        const double volume = dot(ahead, plain_cross(edge_u, edge_v));
        origin_ = start_ = corner;
        row_x_ = (double(columns_) / volume) * plain_cross(edge_v, ahead);
        row_y_ = (double(rows_) / volume) * plain_cross(ahead, edge_u);
        row_z_ = ahead_ = ahead;
        across_ = (1 / double(columns_)) * edge_u;
        along_ = (1 / double(rows_)) * edge_v;
    }

    /// A pyramid from `origin`: `ahead`, `right`, `up` unit and perpendicular, the half angles' tangents.
    void set_perspective(const ChartVector& origin, const ChartVector& ahead, const ChartVector& right,
                         const ChartVector& up, double tan_x, double tan_y) {
        is_perspective_ = true;
        origin_ = origin;
        middle_x_ = double(columns_) / 2, middle_y_ = double(rows_) / 2;
        row_w_ = row_z_ = ahead_ = ahead;
        offset_w_ = 0;
        row_x_ = (middle_x_ / tan_x) * right + middle_x_ * ahead;
        row_y_ = (middle_y_ / tan_y) * up + middle_y_ * ahead;
        across_ = (tan_x / middle_x_) * right;
        along_ = (tan_y / middle_y_) * up;
    }

private:
    std::size_t columns_, rows_;
    ChartVector origin_, start_, row_x_, row_y_, row_z_, row_w_{}, ahead_, across_, along_;
    double offset_x_ = 0, offset_y_ = 0, offset_w_ = 1, middle_x_ = 0, middle_y_ = 0;
    bool is_perspective_ = false;
};
} // namespace detail

/// The chart of a parallelogram on a plane: a floor, a wall, a table top.
class PlaneChart : public detail::ProjectedChart {
public:
    static constexpr bool lies_on_receiver = true;

    /// @param repeats  the parallelogram is a tile: light beyond a side comes in at the opposite one
    template <Vector3 V>
    PlaneChart(const V& corner, const V& edge_u, const V& edge_v, std::size_t columns, std::size_t rows,
               bool repeats = false)
        : ProjectedChart(columns, rows, "PlaneChart"), repeats_(repeats) {
        using namespace detail;
        const Double3 normal = unit_or_zero(plain_cross(double3(edge_u), double3(edge_v)));
        require(length2(normal) > 0.5 && all_finite(double3(corner)), "PlaneChart", "the normal", text_of(normal));
        set_parallel(double3(corner), double3(edge_u), double3(edge_v), -1.0 * normal);
    }

    [[nodiscard]] bool repeats() const { return repeats_; }

private:
    bool repeats_;
};

/// What the camera sees, by perspective.
class ViewChart : public detail::ProjectedChart {
public:
    /// @param up     any vector that is not along the line of sight
    /// @param field  the angle between the upper and the lower side, radians, 0 to π
    template <Vector3 V>
    ViewChart(const V& eye, const V& target, const V& up, double field, std::size_t columns, std::size_t rows)
        : ProjectedChart(columns, rows, "ViewChart") {
        look(double3(eye), double3(target), double3(up), field, "ViewChart");
    }

protected:
    ViewChart(std::size_t columns, std::size_t rows, const char* name) : ProjectedChart(columns, rows, name) {}

    [[nodiscard]] static ChartVector double3(const auto& v) { return detail::double3(v); }

    void look(const ChartVector& eye, const ChartVector& target, const ChartVector& up, double field,
              const char* name) {
        using namespace detail;
        const Double3 ahead = unit_or_zero(target - eye), right = unit_or_zero(plain_cross(ahead, up));
        require(length2(right) > 0.5 && all_finite(eye), name, "the line of sight × up", text_of(right));
        require(field > 0 && field < pi<double>, name, "the field of view", text_of(field));
        const double tan_y = std::tan(field / 2);
        set_perspective(eye, ahead, right, plain_cross(right, ahead), tan_y * double(columns()) / double(rows()),
                        tan_y);
    }
};

/// What a lamp sees, as a shadow map: by perspective from a point, in parallel along a direction.
class LightChart : public ViewChart {
public:
    /// From a point lamp, over the cone about a sphere of receivers.
    template <Vector3 V>
    LightChart(const V& lamp, const V& centre, double radius, std::size_t side) : ViewChart(side, side, "LightChart") {
        const ChartVector eye = double3(lamp), middle = double3(centre), ahead = detail::unit_or_zero(middle - eye);
        const double sine = radius / length(middle - eye);
        require(sine > 0 && sine < 1, "LightChart", "the radius over the distance", detail::text_of(sine));
        look(eye, middle, frame_about(ahead).u, 2 * std::asin(sine), "LightChart");
    }

    /// From a sun, over a sphere of receivers.
    [[nodiscard]] static LightChart along(const auto& direction, const auto& centre, double radius, std::size_t side) {
        LightChart chart(side);
        const ChartVector ahead = detail::unit_or_zero(double3(direction)), middle = double3(centre);
        require(length2(ahead) > 0.5 && all_finite(middle), "LightChart", "the direction", detail::text_of(ahead));
        require(radius > 0 && std::isfinite(radius), "LightChart", "the radius", detail::text_of(radius));
        const Frame<ChartVector> frame = frame_about(ahead);
        chart.set_parallel(middle - radius * (frame.u + frame.v + ahead), (2 * radius) * frame.u,
                           (2 * radius) * frame.v, ahead);
        return chart;
    }

private:
    explicit LightChart(std::size_t side) : ViewChart(side, side, "LightChart") {}
};

static_assert(RasterChart<PlaneChart> && RasterChart<ViewChart> && RasterChart<LightChart>);

} // namespace nephroid
