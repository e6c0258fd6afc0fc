// SPDX-License-Identifier: MIT
/// @file  Finds the features of a photon map and the photons on them: Section 3.2 of Spencer and Jones 2009.
#pragma once

#include "nephroid/execution/counting_sort.hpp"
#include "nephroid/execution/executor.hpp"
#include "nephroid/relaxation/feature_search.hpp"
#include "nephroid/relaxation/photon_constraint.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace nephroid::detail {

/// Goes over the photons and searches the neighbourhoods of those that no earlier search covers; then follows the
/// features found, searching at the photons on them.
///
/// Each leaf of the tree goes over its own photons alone, so that the result does not depend on the threads. This takes
/// a few more searches than one pass over all photons.
template <class Cloud>
class FeatureDetector {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    FeatureDetector(const Cloud& cloud, const RelaxationOptions& options)
        : cloud_(&cloud), options_(&options), state_(cloud.tree().slots(), State::uncovered),
          lines_(cloud.tree().slots()) {}

    template <class E>
    void run(E& executor) {
        const std::size_t leaves = cloud_->tree().leaves().size();
        std::vector<std::vector<Feature<V>>> found(leaves);
        std::vector<std::size_t> searches(leaves);
        for (unsigned round = 0; round < rounds; ++round) {
            for_each_leaf<FeatureSearch<Cloud>>(cloud_->tree(), executor, [&](auto& search, std::uint32_t leaf) {
                found[leaf].clear();
                searches[leaf] = search_leaf(leaf, round == 0, search, found[leaf]);
            });
            searches_ = std::accumulate(searches.begin(), searches.end(), searches_);
            if (!add_features(found, executor))
                break;
        }
    }

    [[nodiscard]] std::size_t searches() const { return searches_; }

    /// How features hold the photon in a slot.
    [[nodiscard]] PhotonConstraint<V> constraint(std::size_t slot) const {
        const Lines& lines = lines_[slot];
        const T half = T(0.5) * (lines.uu - lines.vv), root = sqrt(square(half) + square(lines.uv));
        // Where features of many directions meet, no direction is free: the photon is held back in all.
        if (!(root > least_anisotropy * T(0.5) * (lines.uu + lines.vv)))
            return {zero_vector<V>(), lines.weight};
        // The eigenvector of the larger eigenvalue, from the row that does not cancel.
        const T a = half >= T(0) ? half + root : lines.uv, b = half >= T(0) ? lines.uv : root - half;
        const T size = sqrt(a * a + b * b);
        const Frame<V> frame = frame_about(cloud_->normal(slot));
        return {(a / size) * frame.u + (b / size) * frame.v, lines.weight};
    }

private:
    enum class State : unsigned char {
        uncovered,
        covered, ///< lies in a searched neighbourhood
        followed ///< was searched, or lies next to a photon on a feature that was searched
    };

    /// The features through a photon: Σ ι' g gᵀ in its frame, as a line has no sign, and the largest ι'. [The
    /// paper, eq. 9, adds up vectors, which cancel between the two edges of a thin bar.]
    struct Lines {
        T uu{0}, uv{0}, vv{0}, weight{0};
    };

    /// A feature is followed for so many neighbourhoods, less one, from where it was found.
    static constexpr unsigned rounds = 8;
    /// A search covers the photons within this fraction of its neighbourhood's radius [Section 3.2.2].
    static constexpr T cover = T(0.6);
    static constexpr T cover_along_feature = T(0.2); ///< the same along features: ours
    /// From this anisotropy on the lines through a photon have a common direction.
    static constexpr T least_anisotropy = T(0.35);

    /// Searches at one leaf's photons. @return  how many searches
    std::size_t search_leaf(std::uint32_t leaf, bool first, FeatureSearch<Cloud>& search,
                            std::vector<Feature<V>>& found) {
        const TreeLeaf range = cloud_->tree().leaves()[leaf];
        const State covered = first ? State::covered : State::followed;
        std::size_t searches = 0;
        for (std::uint32_t slot = range.first; slot < range.first + range.size; ++slot) {
            if (state_[slot] >= covered || (!first && !(lines_[slot].weight > T(0))))
                continue;
            const T radius = search(*cloud_, *options_, slot, found);
            ++searches;
            const T reach2 = square((first ? cover : cover_along_feature) * radius);
            for (std::uint32_t other = range.first; other < range.first + range.size; ++other)
                if (length2(cloud_->position(other) - cloud_->position(slot)) <= reach2)
                    state_[other] = (std::max)(state_[other], covered);
            state_[slot] = State::followed;
        }
        return searches;
    }

    /// Adds features to the photons that lie on them [eq. 9], leaf by leaf, each leaf's features in their order.
    /// @return  whether there were any
    template <class E>
    bool add_features(const std::vector<std::vector<Feature<V>>>& found, E& executor) {
        using t = vector_traits<V>;
        const PointTree<V>& tree = cloud_->tree();
        struct Meeting {
            std::uint32_t leaf;
            const Feature<V>* feature;
        };
        std::vector<Meeting> meetings;
        for (const auto& features : found)
            for (const Feature<V>& feature : features) {
                const V centre = cloud_->position(feature.origin);
                const T r = feature.radius;
                const Box<T> box{{t::x(centre) - r, t::y(centre) - r, t::z(centre) - r},
                                 {t::x(centre) + r, t::y(centre) + r, t::z(centre) + r}};
                tree.visit_leaves(box, [&](std::uint32_t leaf) { meetings.push_back({leaf, &feature}); });
            }
        CountingSort<const Feature<V>*> by_leaf;
        by_leaf.start(1, tree.leaves().size());
        for (const Meeting& meeting : meetings)
            by_leaf.count(0, meeting.leaf);
        by_leaf.make_room();
        for (const Meeting& meeting : meetings)
            by_leaf.put(0, meeting.leaf, meeting.feature);

        for_each_leaf<NoScratch>(tree, executor, [&](NoScratch, std::uint32_t leaf) {
            for (const Feature<V>* const feature : by_leaf.items_of(leaf))
                add_feature(*feature, tree.leaves()[leaf]);
        });
        return !meetings.empty();
    }

    /// Adds a feature to those photons of a leaf that lie on it.
    void add_feature(const Feature<V>& feature, const TreeLeaf& range) {
        const V origin = cloud_->position(feature.origin);
        const V line = cross(feature.axis, cloud_->normal(feature.origin));
        for (std::uint32_t slot = range.first; slot < range.first + range.size; ++slot) {
            const V offset = cloud_->position(slot) - origin;
            if (!(length2(offset) <= square(feature.radius)) ||
                !(abs(dot(offset, feature.axis) - feature.offset) <= feature.band) ||
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

} // namespace nephroid::detail
