// SPDX-License-Identifier: MIT
/// @file  What the tests of the exact images share: differences of images, and points for brute force.
#pragma once

#include "nephroid/quality/reference/film.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nephroid::reference {

/// @return  the greatest difference of two pixels, over the greater of the exact pixel and `floor` times the mean
[[nodiscard]] inline double worst_difference(const Image& image, const Image& exact, double floor = 0.01) {
    const double least = floor * mean(exact);
    double worst = image.size() == exact.size() ? 0 : HUGE_VAL;
    for (std::size_t i = 0; i < exact.size() && i < image.size(); ++i)
        worst = (std::max)(worst, std::abs(image[i] - exact[i]) / (std::max)(std::abs(exact[i]), least));
    return worst;
}

/// @return  the image with each block of `n` x `n` pixels replaced by their mean; n divides both sizes
[[nodiscard]] inline Image averaged(const Image& image, const Film& film, int n) {
    Image blocks(image.size() / static_cast<std::size_t>(n * n));
    for (int j = 0; j < film.height; ++j)
        for (int i = 0; i < film.width; ++i)
            blocks[static_cast<std::size_t>(j / n * (film.width / n) + i / n)] +=
                image[static_cast<std::size_t>(j * film.width + i)] / (n * n);
    return blocks;
}

/// Adds `flux` landing at (x, y) to the pixel there, if there is one, as irradiance.
inline void add_flux(Image& image, const Film& film, double x, double y, double flux) {
    const double i = std::floor((x - film.x_min) / film.pixel_width()),
                 j = std::floor((y - film.y_min) / film.pixel_height());
    if (i >= 0 && j >= 0 && i < film.width && j < film.height)
        image[static_cast<std::size_t>(j) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(i)] +=
            flux / (film.pixel_width() * film.pixel_height());
}

/// A point of an additive recurrence that fills the unit square evenly.
/// Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (the plastic number).
struct LatticePoint {
    double u, v;
    explicit LatticePoint(int index)
        : u(fraction(0.5 + 0.75487766624669276 * index)), v(fraction(0.5 + 0.56984029099805327 * index)) {}

private:
    static double fraction(double x) { return x - std::floor(x); }
};

/// Three numbers, for brute force in space.
struct Vector {
    double x, y, z;
    friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};
[[nodiscard]] inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Snell's law for the unit direction `d`, the unit normal `n` against it, and the ratio `eta` of the indices before
/// and behind; multiplies `flux` by the unpolarised transmittance, written with the refracted angle (not as in
/// fresnel.hpp).
[[nodiscard]] inline Vector refract(Vector d, Vector n, double eta, double& flux) {
    const double i = std::acos(-dot(d, n)), t = std::asin(eta * std::sin(i));
    if (i > 1e-6) {
        const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
        flux *= 1 - 0.5 * (s * s + p * p);
    } else {
        flux *= 4 * eta / ((1 + eta) * (1 + eta));
    }
    return eta * d + (eta * std::cos(i) - std::cos(t)) * n;
}

} // namespace nephroid::reference
