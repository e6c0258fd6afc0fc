// SPDX-License-Identifier: MIT
/// @file  Splits paths by the smooth pieces of surface that photons meet, for renderers whose `surface` does not tell
///        them apart: hits may have none, or one for all objects of a material, or one for an object with edges and
///        steps. A path is split by the piece that its photons meet first, and by the piece that they land on.
#pragma once

#include "nephroid/execution/task_runner.hpp"
#include "nephroid/smoothing/second_order/emission_cells.hpp"
#include "nephroid/smoothing/second_order/surface_pieces.hpp"
#include "nephroid/transport/hit.hpp"
#include "nephroid/transport/trail.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A path's signature, and where it first met a surface.
template <Vector3 V>
class PathTrail : public PathSignature {
public:
    template <class Hit>
    void meet(const Hit& hit, bool from_front, bool passed) {
        PathSignature::meet(hit, from_front, passed);
        if constexpr (HasPosition<Hit, V>)
            if (!first_) {
                const double side = from_front ? 1 : -1;
                first_ = {double3(V(hit.position)), side * double3(V(hit.geometric_normal))};
            }
    }

    /// Nothing where hits have no position.
    [[nodiscard]] const std::optional<PlaceOnSurface>& first() const { return first_; }

private:
    std::optional<PlaceOnSurface> first_;
};

/// The pieces into which the paths of a pilot are split.
template <Vector3 V>
class PathPieces {
public:
    using FirstPoints = std::vector<std::optional<PlaceOnSurface>>;

    PathPieces() = default;
    /// Splits the paths of photons: those on the largest pieces keep their signatures, the others get new ones.
    ///
    /// @param photons  TracedPhoton of one light or of several
    /// @param firsts   where each first met a surface
    template <class Photons>
    PathPieces(Photons& photons, const FirstPoints& firsts, const TaskRunner& run) {
        std::vector<std::array<double, 2>> samples;
        samples.reserve(photons.size());
        for (const auto& photon : photons)
            samples.push_back(photon.sample.at);
        const EmissionCells cells(samples, 1, false);
        std::vector<std::uint32_t> landed; // sorted so that consecutive ones are neighbours in the domain
        for (std::size_t n = 0; n < cells.size(); ++n) {
            const std::size_t row = n / cells.columns(), column = n % cells.columns(); // every other row runs backwards
            const std::size_t cell = row % 2 == 0 ? n : (row + 1) * cells.columns() - 1 - column;
            for (const std::uint32_t i : cells.photons(cell))
                if (photons[i].deposit && photons[i].sample.coordinates >= 2) // others have no neighbours
                    landed.push_back(i);
        }
        std::stable_sort(landed.begin(), landed.end(),
                         [&](auto a, auto b) { return key_of(photons[a]) < key_of(photons[b]); });
        for (auto begin = landed.begin(); begin != landed.end();) {
            const Key key = key_of(photons[*begin]);
            const auto end = std::find_if(begin, landed.end(), [&](auto i) { return key_of(photons[i]) != key; });
            const auto first_of = [&](std::uint32_t i) { return firsts[i]; };
            const auto landing_of = [&](std::uint32_t i) { return landing(photons[i]); };
            Path path{key, pieces_of(begin, end, first_of, run), pieces_of(begin, end, landing_of, run)};
            for (auto i = begin; i != end; ++i) {
                const auto place = std::size_t(i - begin);
                photons[*i].signature = split_signature(key.second, path.by_first ? (*path.by_first)[place] : 0,
                                                        path.by_landing ? (*path.by_landing)[place] : 0);
            }
            if (path.by_first || path.by_landing)
                paths_.push_back(std::move(path));
            begin = end;
        }
    }

    /// Gives a photon that is not of the pilot the signature of the pieces that it met.
    template <class Photon>
    void assign_piece(Photon& photon, const std::optional<PlaceOnSurface>& first) const {
        if (paths_.empty() || !photon.deposit)
            return;
        const auto path = std::lower_bound(paths_.begin(), paths_.end(), key_of(photon),
                                           [](const Path& a, const Key& b) { return a.key < b; });
        if (path == paths_.end() || path->key != key_of(photon))
            return;
        photon.signature =
            split_signature(photon.signature, path->by_first && first ? path->by_first->piece_at(*first) : 0,
                            path->by_landing ? path->by_landing->piece_at(*landing(photon)) : 0);
    }

private:
    using Pieces = std::optional<SurfacePieces<V>>;
    using Key = std::pair<std::uint32_t, std::uint32_t>; // light and signature
    struct Path {
        Key key;
        Pieces by_first, by_landing;
    };

    [[nodiscard]] static Key key_of(const PathSample& photon) { return {photon.sample.light, photon.signature}; }

    template <class Photon>
    [[nodiscard]] static std::optional<PlaceOnSurface> landing(const Photon& photon) {
        return PlaceOnSurface{double3(photon.deposit->position), double3(photon.deposit->normal)};
    }

    /// The signature of two pieces; unchanged for the largest ones, which have the number 0.
    [[nodiscard]] static std::uint32_t split_signature(std::uint32_t signature, std::uint32_t first,
                                                       std::uint32_t landing) {
        return signature ^ (first * 0x9e3779b9u) ^ (landing * 0x85ebca6bu);
    }

    /// The pieces that points lie on. Nothing if there is only one, or if most points are on pieces with a few points
    /// only, as on a very rough surface.
    template <class Iterator, class PointOf>
    [[nodiscard]] static Pieces pieces_of(Iterator begin, Iterator end, const PointOf& point_of,
                                          const TaskRunner& run) {
        bool is_whole = true;
        for (auto i = begin; i != end; ++i) {
            const std::optional<PlaceOnSurface> point = point_of(*i);
            if (!point || !std::isfinite(inner(point->position, point->position)))
                return std::nullopt;
            is_whole = is_whole && (i == begin || may_share_surface(*point_of(*(i - 1)), *point));
        }
        if (is_whole)
            return std::nullopt;
        std::vector<PlaceOnSurface> points;
        for (auto i = begin; i != end; ++i)
            points.push_back(*point_of(*i));
        Pieces pieces(std::in_place, std::move(points), run);
        constexpr std::uint32_t few = 64;
        double on_small_pieces = 0;
        for (const std::uint32_t size : pieces->sizes())
            on_small_pieces += size < few ? size : 0;
        if (pieces->sizes().size() == 1 || on_small_pieces > 0.5 * double(end - begin))
            pieces.reset();
        return pieces;
    }

    std::vector<Path> paths_; // those that are split, sorted by key
};

} // namespace nephroid::detail
