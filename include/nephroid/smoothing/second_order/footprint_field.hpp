// SPDX-License-Identifier: MIT
/// @file  A field of footprints over the two-dimensional emission domain of one light.
#pragma once

#include "nephroid/smoothing/second_order/group_field.hpp"

namespace nephroid::detail {

/// Shapes of footprints and second derivatives of the map, with one field for each path group.
class FootprintField {
public:
    /// @param photons   of one light, emitted with smoothing 1, with two emission coordinates: a random-access range of
    ///                  TracedPhoton
    /// @param executor  runs the fits; the field does not depend on it
    template <class Photons, class E>
    FootprintField(const Photons& photons, const FieldOptions& options, E& executor)
        : FootprintField(PathSamples(photons), options, TaskRunner(executor)) {}
    FootprintField(const PathSamples& photons, const FieldOptions& options, const TaskRunner& run) {
        const PathGroups groups(photons, options.repeats, run);
        groups_.reserve(groups.groups().size());
        for (const PathGroup& group : groups.groups()) {
            groups_.push_back({group.signature, std::nullopt});
            if (double(group.photons.size()) >= fewest)
                groups_.back().field.emplace(photons, groups, group, options, run);
        }
    }

    /// @return  nothing where the photons determine nothing: too few of them took this path
    [[nodiscard]] std::optional<FieldSample> at(const std::array<double, 2>& sample, const EmissionFrame& frame,
                                                std::uint32_t signature) const {
        const Group* group = find(signature);
        return group != nullptr && group->field ? group->field->at(sample, frame) : std::nullopt;
    }

private:
    static constexpr double fewest = 4 * EmissionCells::photons_per_cell;

    struct Group {
        std::uint32_t signature;
        std::optional<GroupField> field;
    };

    [[nodiscard]] const Group* find(std::uint32_t signature) const {
        const auto found = std::lower_bound(groups_.begin(), groups_.end(), signature,
                                            [](const Group& a, std::uint32_t b) { return a.signature < b; });
        return found != groups_.end() && found->signature == signature ? &*found : nullptr;
    }

    std::vector<Group> groups_; // sorted by signature
};

} // namespace nephroid::detail
