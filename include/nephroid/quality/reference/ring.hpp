// SPDX-License-Identifier: MIT
/// @file  The exact caustic of a half cylinder mirror on the floor it stands on.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/quality/reference/film.hpp"
#include "nephroid/quality/reference/ring_chord.hpp"
#include "nephroid/quality/reference/ring_gallery.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nephroid::reference {

enum class Reflections {
    any, ///< light is followed until it reaches the floor
    one  ///< light that would hit the mirror a second time is discarded
};

/// A perfect mirror on the inner side of the half cylinder x^2 + y^2 = 1, x >= 0, 0 <= z <= 0.5, lit along
/// (cos 35 degrees, 0, -sin 35 degrees) with irradiance 1 on horizontal planes; the floor is z = 0.
/// Nothing casts a shadow: only what the mirror reflects is counted, and all of it lands at x > 0 inside the cylinder.
struct Ring {
    Reflections reflections = Reflections::any;
};

namespace detail {

/// The horizontal distance that light travels down from the mirror's upper edge: 0.5 cot(35 degrees).
inline const double ring_reach = 0.5 / std::tan(35 * std::numbers::pi / 180);

inline void check(const Ring& ring) {
    require(ring.reflections == Reflections::any || ring.reflections == Reflections::one, "ring", "reflections",
            static_cast<double>(ring.reflections), "be a Reflections");
}

/// One chord of the light, with the angles that all pixels of a film share.
class ChordOnFilm {
public:
    /// @param mirrored  for the light that meets the mirror at y < 0: the same chords on the film upside down
    ChordOnFilm(const Chord& chord, const Film& film, bool mirrored)
        : chord_(chord), film_(film), mirrored_(mirrored), columns_(static_cast<std::size_t>(film.width) + 1) {
        for (int i = 0; i <= film.width; ++i)
            if (film.x(i) >= 0 && film.x(i) <= 1)
                chord.ends_pass(film.x(i), false, columns_[static_cast<std::size_t>(i)]);
    }

    /// Adds the flux on each pixel of row `j` to `row`.
    void add_row(int j, double* row) const {
        const double y0 = mirrored_ ? -film_.y(j + 1) : film_.y(j), y1 = mirrored_ ? -film_.y(j) : film_.y(j + 1);
        // All chords lie between the circles of radius nearest() and 1.
        const double y_near = (std::fmax)(0.0, (std::fmax)(y0, -y1)), y_far = (std::fmax)(std::abs(y0), std::abs(y1));
        if (y_near >= 1)
            return;
        const double x_near = std::sqrt((std::fmax)(0.0, chord_.nearest() * chord_.nearest() - y_far * y_far));
        const int begin = columns_before(x_near),
                  end = columns_before(std::sqrt(1 - y_near * y_near) + film_.pixel_width());
        if (begin >= end)
            return;

        std::vector<double> ends, left, right, phis;
        chord_.ends_pass(y0, true, ends);
        chord_.ends_pass(y1, true, ends);
        passes_corners(begin, y0, y1, left);
        for (int i = begin; i < end; ++i, left.swap(right)) {
            right.clear();
            passes_corners(i + 1, y0, y1, right);
            phis.assign({chord_.first(), chord_.last()});
            const auto column = static_cast<std::size_t>(i);
            const auto append = [&](const std::vector<double>& more) {
                phis.insert(phis.end(), more.begin(), more.end());
            };
            append(ends);
            append(left);
            append(right);
            append(columns_[column]);
            append(columns_[column + 1]);
            std::sort(phis.begin(), phis.end());
            row[i] += chord_.flux({film_.x(i), film_.x(i + 1), y0, y1}, phis);
        }
    }

private:
    void passes_corners(int i, double y0, double y1, std::vector<double>& phis) const {
        chord_.passes_point(film_.x(i), y0, phis);
        chord_.passes_point(film_.x(i), y1, phis);
    }

    /// The number of columns that lie wholly, or nearly so, before `x`.
    [[nodiscard]] int columns_before(double x) const {
        const double i = std::floor((x - film_.x_min) / film_.pixel_width());
        return static_cast<int>((std::clamp)(i, 0.0, static_cast<double>(film_.width)));
    }

    Chord chord_;
    Film film_;
    bool mirrored_;
    std::vector<std::vector<double>> columns_; ///< angles at which a chord's end passes each side of the columns
};

} // namespace detail

/// The flux that the mirror reflects to the floor, from closed forms: each strip of the mirror receives
/// cot(35 degrees) cos(phi) per height and angle, and light flies a chord, 2 cos(phi), before it hits the mirror again.
/// Throws `std::invalid_argument` if `reflections` is not one of its values.
[[nodiscard]] inline double ring_flux(const Ring& ring) {
    detail::check(ring);
    const double reach = detail::ring_reach;
    if (ring.reflections == Reflections::any)
        return 2 * reach;
    const double again = std::acos(0.5 * reach); // beyond this angle some light hits a second time
    return 2 * (reach * std::sin(again) + 0.5 * std::numbers::pi - again - 0.5 * std::sin(2 * again));
}

/// Computes the caustic on the floor inside a half cylinder mirror.
///
/// @param film      any rectangle
/// @param executor  who runs the work; the result does not depend on it, bit for bit
/// @return  irradiances averaged over the pixels, exact to about 1e-8 of themselves. With any number of reflections:
///          to 1e-6 along the mirror, and to 1e-6 of the image's mean in pixels on the mirror near (0, 1) and (0, -1),
///          for pixels with sides above 1e-4
/// Throws `std::invalid_argument` if the film is out of range, or `reflections` is not one of its values.
template <ExecutorArgument E = ThreadExecutor>
[[nodiscard]] Image ring(const Ring& ring, const Film& film, E&& executor = E{}) {
    Image image = detail::blank(film, "ring");
    detail::check(ring);

    // Light that is reflected many times creeps along the mirror: its chords after the first `count` are taken
    // together.
    const double side = (std::min)(film.pixel_width(), film.pixel_height());
    const bool any = ring.reflections == Reflections::any;
    const int count = any ? detail::Gallery::chords_before(detail::ring_reach, side) : 1;
    const detail::Gallery gallery(detail::ring_reach, count);
    const double last = any ? gallery.first() : 0.5 * std::numbers::pi;

    const double farthest = std::hypot((std::max)(std::abs(film.x_min), std::abs(film.x_max)),
                                       (std::max)(std::abs(film.y_min), std::abs(film.y_max)));
    std::vector<detail::ChordOnFilm> chords;
    for (int k = 0; k < count; ++k)
        if (const detail::Chord chord(k, detail::ring_reach, last); chord.nearest() < farthest)
            for (const bool mirrored : {false, true})
                chords.emplace_back(chord, film, mirrored);

    executor(static_cast<std::size_t>(film.height), [&](std::size_t row_number) {
        const int j = static_cast<int>(row_number);
        double* row = image.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(film.width);
        for (const detail::ChordOnFilm& chord : chords)
            chord.add_row(j, row);
        for (int i = 0; i < film.width; ++i) {
            const detail::Rectangle pixel{film.x(i), film.x(i + 1), film.y(j), film.y(j + 1)};
            if (any)
                row[i] += gallery.flux(pixel) + gallery.flux({pixel.x0, pixel.x1, -pixel.y1, -pixel.y0});
            row[i] /= (pixel.x1 - pixel.x0) * (pixel.y1 - pixel.y0);
        }
    });
    return image;
}

} // namespace nephroid::reference
