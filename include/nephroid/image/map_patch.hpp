// SPDX-License-Identifier: MIT
/// @file  A patch of light on a raster: cut into triangles of equal flux, whose exact areas go to the texels.
#pragma once

#include "nephroid/image/raster_chart.hpp"
#include "nephroid/image/raster_tiles.hpp"
#include "nephroid/image/texel_coverage.hpp"
#include "nephroid/sheet/lit_patch.hpp"
#include "nephroid/sheet/tessellation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// A patch, where it lies on the raster, and how finely it is cut.
template <Vector3 V, Flux F>
struct MapPatch {
    LitPatch<V, F> patch;
    ChartVector middle, normal; ///< of the whole patch
    double sag = 0;             ///< how far it leaves its plane
    unsigned quads = 1;         ///< along each side
    std::size_t turn = 0;       ///< odd: the first quad's diagonal is the other one, so that neighbours' alternate
    RasterBox box;
};

/// Where a patch lies on the raster; its box is empty if the chart does not see it whole or sees it edge-on.
template <Vector3 V, Flux F, class C>
[[nodiscard]] MapPatch<V, F> map_patch(const LitPatch<V, F>& patch, const Tessellation& rule, const C& chart) {
    MapPatch<V, F> made{patch, {}, {}, PatchSag(patch).sag, 1, 0, {}};
    const auto& c = patch.corners;
    RasterBox box;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            made.middle += 0.25 * c[i][j].position;
            made.normal += patch.normal[i][j];
            // The patch lies within its Bézier points' hull.
            const Double3 u = (i == 0 ? 1.0 / 3 : -1.0 / 3) * c[i][j].along_u,
                          v = (j == 0 ? 1.0 / 3 : -1.0 / 3) * c[i][j].along_v,
                          uv = (i == j ? 1.0 / 9 : -1.0 / 9) * adini_twist(c, i, j);
            for (const Double3& point :
                 {c[i][j].position, c[i][j].position + u, c[i][j].position + v, c[i][j].position + u + v + uv}) {
                const auto place = chart.place(point);
                if (!place || !std::isfinite(place->x) || !std::isfinite(place->y))
                    return made;
                box.include(place->x, place->y);
            }
        }
    made.normal = unit_or_zero(made.normal);
    const auto place = chart.place(made.middle);
    const double scale = place ? place->area_scale(made.normal) : 0;
    if (!(scale > 0) || scale < 1e-3 * place->largest_area_scale())
        return made;
    made.quads = quads_along(shape_of(c, made.normal), rule, 1 / std::sqrt(scale), 1);
    made.box = box;
    return made;
}

/// Cuts patches into triangles and sums up their areas; keeps its memory from one patch to the next.
class PatchTexels {
public:
    /// @return  the areas, weighted so that each is the irradiance of a unit of flux on the patch
    template <Vector3 V, Flux F, class C>
    const TexelCoverage& cover(const MapPatch<V, F>& made, const RasterWindow& window, const C& chart) {
        coverage_.reset(window.columns, window.rows);
        const std::size_t m = made.quads;
        points_.resize((m + 1) * (m + 1));
        scale_.resize((m + 1) * (m + 1));
        const HermitePatch patch(made.patch.corners);
        const double left = double(window.column) - window.shift_x, low = double(window.row) - window.shift_y;
        for (std::size_t j = 0; j <= m; ++j) {
            const auto curve = patch.curve_at(double(j) / double(m));
            for (std::size_t i = 0; i <= m; ++i) {
                const auto place = chart.place(HermitePatch::on(curve, double(i) / double(m)));
                if (!place) // within the hull of points that the chart sees
                    return coverage_;
                points_[j * (m + 1) + i] = {place->x - left, place->y - low};
                scale_[j * (m + 1) + i] = place->area_scale(made.normal);
            }
        }
        weigh_triangles(m, made.turn);
        add_edges(m, made.turn);
        return coverage_;
    }

private:
    /// The two triangles of a quad, as the weights of their edges; 0 for what is added as a point or a line.
    struct QuadWeights {
        double low, high; ///< on the side of the quad's lower row of corners, and of its upper one
    };

    /// Whether a quad is cut from its first corner to the last, or between the two others.
    [[nodiscard]] static bool cut_from_first(std::size_t i, std::size_t j, std::size_t turn) {
        return (i + j + turn) % 2 == 0;
    }

    void weigh_triangles(std::size_t m, std::size_t turn) {
        weights_.resize(m * m);
        const double share = 0.5 / double(m * m);
        for (std::size_t j = 0; j < m; ++j)
            for (std::size_t i = 0; i < m; ++i) {
                const std::size_t a = j * (m + 1) + i, b = a + 1, d = a + m + 1, c = d + 1;
                weights_[j * m + i] = cut_from_first(i, j, turn)
                                          ? QuadWeights{weigh(a, b, c, share), weigh(a, c, d, share)}
                                          : QuadWeights{weigh(a, b, d, share), weigh(b, c, d, share)};
            }
    }

    /// Each edge once: with the weight on its left less that on its right.
    void add_edges(std::size_t m, std::size_t turn) {
        constexpr QuadWeights none{0, 0};
        const auto quad = [&](std::size_t i, std::size_t j) { return i < m && j < m ? weights_[j * m + i] : none; };
        for (std::size_t j = 0; j <= m; ++j)
            for (std::size_t i = 0; i <= m; ++i) {
                const TexelPoint* const a = &points_[j * (m + 1) + i];
                const QuadWeights here = quad(i, j), left = quad(i - 1, j), below = quad(i, j - 1);
                if (i < m)
                    coverage_.add_edge(a[0], a[1], here.low - below.high);
                if (j < m) {
                    // The lower triangle has the right side where the cut begins at the first corner, else the left.
                    const double right_of_left = cut_from_first(i - 1, j, turn) ? left.low : left.high;
                    coverage_.add_edge(a[0], a[m + 1],
                                       right_of_left - (cut_from_first(i, j, turn) ? here.high : here.low));
                }
                if (i < m && j < m) {
                    if (cut_from_first(i, j, turn))
                        coverage_.add_edge(a[0], a[m + 2], here.high - here.low);
                    else
                        coverage_.add_edge(a[1], a[m + 1], here.low - here.high);
                }
            }
    }

    /// The weight of a triangle's edges, counter-clockwise; without area, or within a texel, it is added here instead.
    [[nodiscard]] double weigh(std::size_t a, std::size_t b, std::size_t c, double share) {
        const TexelPoint &p = points_[a], &q = points_[b], &r = points_[c];
        const double amount = share * (scale_[a] + scale_[b] + scale_[c]) / 3;
        if (TexelCoverage::share_texel(p, q) && TexelCoverage::share_texel(p, r)) {
            coverage_.add_point(p, amount);
            return 0;
        }
        const double ux = q.x - p.x, uy = q.y - p.y, vx = r.x - p.x, vy = r.y - p.y;
        const double area = 0.5 * (ux * vy - uy * vx);
        const double size2 = (std::max)({ux * ux + uy * uy, vx * vx + vy * vy, square(vx - ux) + square(vy - uy)});
        if (std::abs(area) <= 1e-8 + 1e-6 * size2) {
            add_line(p, q, r, amount);
            return 0;
        }
        return amount / area;
    }

    /// A triangle without area: along its longest side, in steps of an eighth of a texel.
    void add_line(const TexelPoint& p, const TexelPoint& q, const TexelPoint& r, double amount) {
        const auto size = [](const TexelPoint& a, const TexelPoint& b) { return std::hypot(b.x - a.x, b.y - a.y); };
        TexelPoint from = p, to = q;
        if (size(q, r) > size(from, to))
            from = q, to = r;
        if (size(r, p) > size(from, to))
            from = r, to = p;
        const auto steps = std::size_t((std::min)(std::ceil(8 * size(from, to)), 65536.0)) + 1;
        for (std::size_t k = 0; k < steps; ++k) {
            const double t = (double(k) + 0.5) / double(steps);
            coverage_.add_point({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)}, amount / double(steps));
        }
    }

    TexelCoverage coverage_;
    std::vector<TexelPoint> points_;
    std::vector<double> scale_;
    std::vector<QuadWeights> weights_;
};

} // namespace nephroid::detail
