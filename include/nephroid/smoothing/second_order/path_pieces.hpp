// SPDX-License-Identifier: MIT
/// @file  Paths told apart by what the photons do, where the renderer's `surface` does not tell: it may have none, or
///        name materials, or one object with edges and steps. Photons of one path are parted by the first surface that
///        turned them, and by that on which they landed.
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

/// A path's signature, and the first surface that it met.
template <Vector3 V>
class PathTrail : public PathSignature {
public:
    template <class Hit>
    void meet(const Hit& hit, bool from_front, bool passed) {
        PathSignature::meet(hit, from_front, passed);
        if constexpr (HasPosition<Hit, V>)
            if (!first_) {
                const double side = from_front ? 1 : -1;
                first_ = {space3(V(hit.position)), side * space3(V(hit.geometric_normal))};
            }
    }

    /// Nothing where hits have no position.
    [[nodiscard]] const std::optional<PlaceOnSurface>& first() const { return first_; }

private:
    std::optional<PlaceOnSurface> first_;
};

/// What a pilot's photons say of where paths part.
template <Vector3 V>
class PathPieces {
public:
    using FirstPoints = std::vector<std::optional<PlaceOnSurface>>;

    PathPieces() = default;
    /// Gives photons whose path is parted signatures of their own. Others keep theirs, and so do those on the largest
    /// piece of each surface.
    ///
    /// @param photons  TracedPhoton of one light or of several
    /// @param firsts   where each was first turned
    template <class Photons>
    PathPieces(Photons& photons, const FirstPoints& firsts, const TaskRunner& run) {
        std::vector<std::array<double, 2>> samples;
        samples.reserve(photons.size());
        for (const auto& photon : photons)
            samples.push_back(photon.sample.at);
        const EmissionCells cells(samples, 1, false);
        std::vector<std::uint32_t> landed; // neighbours one after the other
        for (std::size_t n = 0; n < cells.size(); ++n) {
            const std::size_t row = n / cells.columns(), column = n % cells.columns(); // there and back again
            const std::size_t cell = row % 2 == 0 ? n : (row + 1) * cells.columns() - 1 - column;
            for (const std::uint32_t i : cells.photons(cell))
                if (photons[i].deposit && photons[i].sample.coordinates >= 2) // else it has no neighbours anyway
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
                photons[*i].signature = parted(key.second, path.by_first ? (*path.by_first)[place] : 0,
                                               path.by_landing ? (*path.by_landing)[place] : 0);
            }
            if (path.by_first || path.by_landing)
                paths_.push_back(std::move(path));
            begin = end;
        }
    }

    /// The same for a photon that was not of the pilot.
    template <class Photon>
    void tell_apart(Photon& photon, const std::optional<PlaceOnSurface>& first) const {
        if (paths_.empty() || !photon.deposit)
            return;
        const auto path = std::lower_bound(paths_.begin(), paths_.end(), key_of(photon),
                                           [](const Path& a, const Key& b) { return a.key < b; });
        if (path == paths_.end() || path->key != key_of(photon))
            return;
        photon.signature = parted(photon.signature, path->by_first && first ? path->by_first->piece_about(*first) : 0,
                                  path->by_landing ? path->by_landing->piece_about(*landing(photon)) : 0);
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
        return PlaceOnSurface{space3(photon.deposit->position), space3(photon.deposit->normal)};
    }

    [[nodiscard]] static std::uint32_t parted(std::uint32_t signature, std::uint32_t first, std::uint32_t landing) {
        return signature ^ (first * 0x9e3779b9u) ^ (landing * 0x85ebca6bu);
    }

    /// Nothing where neighbours nowhere part, and on surfaces so rough that most points have no neighbours on theirs.
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
        double lone = 0;
        for (const std::uint32_t size : pieces->sizes())
            lone += size < few ? size : 0;
        if (pieces->sizes().size() == 1 || lone > 0.5 * double(end - begin))
            pieces.reset();
        return pieces;
    }

    std::vector<Path> paths_; // those that part, sorted
};

} // namespace nephroid::detail
