// SPDX-License-Identifier: MIT
/// @file  The copy of the photons that relaxation works on: in the leaf order of a tree, where neighbours lie together.
#pragma once

#include "nephroid/relaxation/photon_access.hpp"
#include "nephroid/tree/element_at.hpp"
#include "nephroid/tree/point_tree.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// Calls task(scratch, leaf) for each leaf of a tree, some at a time on one thread, which share a `Scratch`.
///
/// @param first, step  leaves first, first + step, … alone
template <class Scratch, class Tree, class E, class Task>
void for_each_leaf(const Tree& tree, E& executor, const Task& task, std::size_t first = 0, std::size_t step = 1) {
    constexpr std::size_t leaves_per_task = 32;
    const std::size_t leaves = tree.leaves().size(), per_task = leaves_per_task * step;
    executor((leaves + per_task - 1) / per_task, [&](std::size_t i) {
        Scratch scratch;
        const std::size_t end = (std::min)(leaves, (i + 1) * per_task);
        for (std::size_t leaf = i * per_task + first; leaf < end; leaf += step)
            task(scratch, std::uint32_t(leaf));
    });
}

struct NoScratch {};

/// Calls task(slot) for each slot that holds a photon.
template <class Tree, class E, class Task>
void for_each_slot(const Tree& tree, E& executor, const Task& task) {
    for_each_leaf<NoScratch>(tree, executor, [&](NoScratch, std::uint32_t leaf) {
        const TreeLeaf range = tree.leaves()[leaf];
        for (std::size_t slot = range.first; slot < range.first + range.size; ++slot)
            task(slot);
    });
}

/// Positions (the tree's own), normals and fluxes by slot. A slot is an index into the tree's leaf order; the slots
/// that pad a leaf to whole lanes are never asked for.
template <Vector3 V, Flux F>
    requires ScalesFlux<F, scalar_t<V>>
class PhotonCloud {
public:
    using T = scalar_t<V>;
    using vector = V;
    using flux_type = F;

    /// @param cos_same_surface  photons whose normals have a smaller cosine between them lie on different surfaces
    /// @param who               the caller's name for error messages
    /// Throws std::invalid_argument naming the photon whose position, normal or flux cannot be.
    template <class Photons, class Access>
    PhotonCloud(Photons& photons, const Access& access, double cos_same_surface,
                const char* who) requires ReadsPhotons<Access, Photons>
        : tree_(
              std::size_t(std::ranges::size(photons)),
              [&](std::size_t i) -> V { return std::invoke(access.position, element_at(photons, i)); }, who),
          cos_same_surface_(T(cos_same_surface)) {
        normals_.reserve(tree_.slots());
        for (std::size_t slot = 0; slot < tree_.slots(); ++slot)
            normals_.push_back(std::invoke(access.normal, element_at(photons, tree_.index(slot))));
        fluxes_.reserve(tree_.slots());
        for (std::size_t slot = 0; slot < tree_.slots(); ++slot)
            fluxes_.push_back(std::invoke(access.flux, element_at(photons, tree_.index(slot))));
        for (std::size_t slot = 0; slot < tree_.slots(); ++slot)
            check(slot, who);
    }

    /// Writes positions back to the photons they came from.
    template <class Photons, class Access, class E>
        requires MovesPhotons<Access, Photons>
    void write_positions(Photons& photons, const Access& access, E& executor) const {
        for_each_slot(tree_, executor, [&](std::size_t slot) {
            std::invoke(access.position, element_at(photons, tree_.index(slot))) = tree_.origin() + position(slot);
        });
    }
    /// The same for normals.
    template <class Photons, class Access, class E>
    void write_normals(Photons& photons, const Access& access, E& executor) const {
        for_each_slot(tree_, executor, [&](std::size_t slot) {
            std::invoke(access.normal, element_at(photons, tree_.index(slot))) = normals_[slot];
        });
    }
    /// The same for fluxes.
    template <class Photons, class Access, class E>
        requires MovesPhotons<Access, Photons>
    void write_fluxes(Photons& photons, const Access& access, E& executor) const {
        for_each_slot(tree_, executor, [&](std::size_t slot) {
            std::invoke(access.flux, element_at(photons, tree_.index(slot))) = fluxes_[slot];
        });
    }

    [[nodiscard]] const PointTree<V>& tree() const { return tree_; }
    [[nodiscard]] PointTree<V>& tree() { return tree_; }

    /// Relative to the tree's origin.
    [[nodiscard]] V position(std::size_t slot) const {
        return make_vector<V>(tree_.x()[slot], tree_.y()[slot], tree_.z()[slot]);
    }
    [[nodiscard]] const V& normal(std::size_t slot) const { return normals_[slot]; }
    void set_normal(std::size_t slot, const V& normal) { normals_[slot] = normal; }
    [[nodiscard]] const F& flux(std::size_t slot) const { return fluxes_[slot]; }
    [[nodiscard]] const std::vector<F>& fluxes() const { return fluxes_; }
    [[nodiscard]] std::vector<F>& fluxes() { return fluxes_; }
    [[nodiscard]] bool same_surface(std::size_t a, std::size_t b) const {
        if (!(dot(normals_[a], normals_[b]) >= cos_same_surface_))
            return false;
        if (sheets_.empty())
            return true;
        const V offset = position(b) - position(a);
        return abs(dot(offset, normals_[a])) <= sheets_[a] && abs(dot(offset, normals_[b])) <= sheets_[b];
    }
    /// Photons that lie farther off a photon's tangent plane than this belong to another of two parallel sheets.
    /// @param sheets  by slot, world units; infinity where there is one sheet alone
    void set_sheets(std::vector<T> sheets) { sheets_ = std::move(sheets); }

private:
    void check(std::size_t slot, const char* who) const {
        const auto photon = [&] { return std::string(who) + ": photon " + std::to_string(tree_.index(slot)); };
        // Two photons may be twice as far apart as each of them is from the origin between them, and the feature search
        // adds up the squared distances of as many as 4,096.
        if (!isfinite(T(4 * 4096) * length2(position(slot))))
            invalid_argument(photon() + " lies at " + text_of(V(tree_.origin() + position(slot))) +
                             ", so far from the others that squared distances overflow; use a larger unit of length");
        if (!(abs(length2(normals_[slot]) - T(1)) < T(0.01)))
            invalid_argument(photon() + " has the normal " + text_of(normals_[slot]) +
                             "; normals must be of unit length");
        const double power = double(flux_traits<F>::power(fluxes_[slot]));
        if (!isfinite(power))
            invalid_argument(photon() + " has a flux of " + text_of(power) + "; fluxes must be finite");
    }

    PointTree<V> tree_;
    std::vector<V> normals_;
    std::vector<F> fluxes_;
    std::vector<T> sheets_; ///< by slot, or empty
    T cos_same_surface_;
};

/// Finds the photons nearest to that in a slot on its surface, itself among them, in no particular order.
///
/// The search ends at 16 · count photons of any surface: where more photons of other surfaces lie between, fewer than
/// `count` are found.
template <class Cloud, Scalar T>
void nearest_on_surface(const Cloud& cloud, std::size_t slot, std::size_t count, std::vector<Neighbour<T>>& found) {
    for (std::size_t wanted = count; wanted <= 16 * count; wanted *= 4) {
        found.resize(wanted);
        found.resize(cloud.tree().nearest(cloud.position(slot), found));
        std::erase_if(found, [&](const auto& other) { return !cloud.same_surface(slot, other.slot); });
        if (found.size() > count) {
            const auto nearer = [](const auto& a, const auto& b) { return a.distance2 < b.distance2; };
            std::nth_element(found.begin(), found.begin() + std::ptrdiff_t(count), found.end(), nearer);
            found.resize(count);
        }
        if (found.size() == count || wanted >= cloud.tree().slots())
            return;
    }
}

} // namespace nephroid::detail
