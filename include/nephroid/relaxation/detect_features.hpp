// SPDX-License-Identifier: MIT
/// @file  Features of a photon map, and the photons that they hold: Section 3.2 of Spencer and Jones 2009.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/relaxation/feature_search.hpp"

#include <numeric>
#include <utility>

namespace nephroid {

namespace detail {

/// Sweeps over the photons, searches the neighbourhood of those that no search has touched yet, then along what was
/// found.
///
/// The leaves sweep by themselves, each over its own photons, so that nothing depends on who runs them: a few more
/// searches than one sweep over all would take.
template <class Cloud>
class FeatureDetector {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    FeatureDetector(const Cloud& cloud, const RelaxationOptions& options)
        : cloud_(&cloud), options_(&options), state_(cloud.tree().slots(), State::untouched),
          lines_(cloud.tree().slots()) {}

    template <class E>
    void run(E& executor) {
        const std::size_t leaves = cloud_->tree().leaves().size();
        std::vector<std::vector<Feature<V>>> found(leaves);
        std::vector<std::size_t> searches(leaves);
        for (unsigned round = 0; round < rounds; ++round) {
            for_each_leaf<FeatureSearch<Cloud>>(cloud_->tree(), executor, [&](auto& search, std::uint32_t leaf) {
                found[leaf].clear();
                searches[leaf] = sweep(leaf, round == 0, search, found[leaf]);
            });
            searches_ = std::accumulate(searches.begin(), searches.end(), searches_);
            if (!mark(found, executor))
                break;
        }
    }

    [[nodiscard]] std::size_t searches() const { return searches_; }

    /// g and w of the photon in a slot.
    [[nodiscard]] PhotonConstraint<V> constraint(std::size_t slot) const {
        const Lines& lines = lines_[slot];
        const T half = T(0.5) * (lines.uu - lines.vv), root = sqrt(square(half) + square(lines.uv));
        // Where features of many directions meet, none of them leads on: the photon is held back in all.
        if (!(root > corner * T(0.5) * (lines.uu + lines.vv)))
            return {zero_vector<V>(), lines.weight};
        // The eigenvector of the larger eigenvalue, from the row that does not cancel.
        const T a = half >= T(0) ? half + root : lines.uv, b = half >= T(0) ? lines.uv : root - half;
        const T size = sqrt(a * a + b * b);
        const Frame<V> frame = frame_about(cloud_->normal(slot));
        return {(a / size) * frame.u + (b / size) * frame.v, lines.weight};
    }

private:
    enum class State : unsigned char {
        untouched,
        touched, ///< lies in a searched neighbourhood
        followed ///< was searched, or lies next to a photon on a feature that was
    };

    /// The features through a photon: Σ ι' g gᵀ in its frame, for a line has no sign [the paper adds up vectors,
    /// eq. 9, which cancel between the two edges of a thin bar], and the largest ι'.
    struct Lines {
        T uu{0}, uv{0}, vv{0}, weight{0};
    };

    static constexpr unsigned rounds = 8; ///< how many neighbourhoods far a feature is followed from where it was seen
    static constexpr T touch = T(0.6);    ///< of a neighbourhood's radius [Section 3.2.2]
    static constexpr T touch_feature = T(0.2); ///< the same along features: ours
    static constexpr T corner = T(0.35);       ///< of the anisotropy of the lines through a photon

    /// One leaf's searches. @return how many
    std::size_t sweep(std::uint32_t leaf, bool first, FeatureSearch<Cloud>& search, std::vector<Feature<V>>& found) {
        const TreeLeaf range = cloud_->tree().leaves()[leaf];
        const State becomes = first ? State::touched : State::followed;
        std::size_t searches = 0;
        for (std::uint32_t slot = range.first; slot < range.first + range.size; ++slot) {
            if (state_[slot] >= becomes || (!first && !(lines_[slot].weight > T(0))))
                continue;
            const T radius = search(*cloud_, *options_, slot, found);
            ++searches;
            const T reach2 = square((first ? touch : touch_feature) * radius);
            for (std::uint32_t other = range.first; other < range.first + range.size; ++other)
                if (length2(cloud_->position(other) - cloud_->position(slot)) <= reach2)
                    state_[other] = (std::max)(state_[other], becomes);
            state_[slot] = State::followed;
        }
        return searches;
    }

    /// Enters features with the photons that lie on them [eq. 9]: sorted by the leaves that they meet, each leaf's in
    /// order.
    /// @return whether there were any
    template <class E>
    bool mark(const std::vector<std::vector<Feature<V>>>& found, E& executor) {
        using t = vector_traits<V>;
        const PointTree<V>& tree = cloud_->tree();
        std::vector<std::pair<std::uint32_t, const Feature<V>*>> meetings;
        std::vector<std::size_t> begin(tree.leaves().size() + 1);
        for (const auto& features : found)
            for (const Feature<V>& feature : features) {
                const V centre = cloud_->position(feature.origin);
                const T r = feature.radius;
                const Box<T> box{{t::x(centre) - r, t::y(centre) - r, t::z(centre) - r},
                                 {t::x(centre) + r, t::y(centre) + r, t::z(centre) + r}};
                tree.visit_leaves(box, [&](std::uint32_t leaf) {
                    meetings.emplace_back(leaf, &feature);
                    ++begin[leaf + 1];
                });
            }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<const Feature<V>*> by_leaf(meetings.size());
        std::vector<std::size_t> end = begin;
        for (const auto& [leaf, feature] : meetings)
            by_leaf[end[leaf]++] = feature;

        for_each_leaf<Nothing>(tree, executor, [&](Nothing, std::uint32_t leaf) {
            for (std::size_t i = begin[leaf]; i < begin[leaf + 1]; ++i)
                mark(*by_leaf[i], tree.leaves()[leaf]);
        });
        return !meetings.empty();
    }

    void mark(const Feature<V>& feature, const TreeLeaf& range) {
        const V origin = cloud_->position(feature.origin);
        const V line = cross(feature.axis, cloud_->normal(feature.origin));
        for (std::uint32_t slot = range.first; slot < range.first + range.size; ++slot) {
            const V offset = cloud_->position(slot) - origin;
            if (!(length2(offset) <= square(feature.radius)) ||
                !(abs(dot(offset, feature.axis) - feature.place) <= feature.band) ||
                !cloud_->same_surface(slot, feature.origin))
                continue;
            const Frame<V> frame = frame_about(cloud_->normal(slot));
            const T u = dot(line, frame.u), v = dot(line, frame.v), w = feature.weight;
            Lines& lines = lines_[slot];
            lines.uu = lines.uu + w * u * u, lines.uv = lines.uv + w * u * v, lines.vv = lines.vv + w * v * v;
            lines.weight = (std::max)(lines.weight, w);
        }
    }

    const Cloud* cloud_;
    const RelaxationOptions* options_;
    std::vector<State> state_; // by slot
    std::vector<Lines> lines_;
    std::size_t searches_ = 0;
};

} // namespace detail

/// The features of a photon map as relaxation sees them.
///
/// @param photons  a random-access range of the user's photons
/// @param access   `photon_access(…)`; nothing is written
/// @return  g and w by photon, in the order of `photons`; g is zero where w is, and where features of several
/// directions meet Throws std::invalid_argument naming the photon whose position or normal cannot be, or the option.
template <class Photons, class Access, class E>
    requires ReadsPhotons<Access, Photons> && Executor<E&>
[[nodiscard]] auto detect_features(Photons&& photons, const Access& access, const RelaxationOptions& options,
                                   E&& executor) {
    using V = detail::position_t<Photons, Access>;
    using Cloud = PhotonCloud<V, detail::flux_t<Photons, Access>>;
    detail::check(options, "detect_features");
    const Cloud cloud(photons, access, options.cos_same_surface, "nephroid::detect_features");
    detail::FeatureDetector<Cloud> detector(cloud, options);
    detector.run(executor);
    std::vector<PhotonConstraint<V>> constraints(std::size_t(std::ranges::size(photons)),
                                                 {zero_vector<V>(), scalar_t<V>(0)});
    detail::for_each_slot(cloud.tree(), executor,
                          [&](std::size_t slot) { constraints[cloud.tree().index(slot)] = detector.constraint(slot); });
    return constraints;
}

} // namespace nephroid
