// SPDX-License-Identifier: MIT
/// @file  What the photons of a light say about one another, sheet by sheet.
#pragma once

#include "nephroid/smoothing/second_order/sheet_field.hpp"

namespace nephroid::detail {

/// Shapes of footprints and second derivatives over the emission domain of one light.
class FootprintField {
public:
    /// @param photons   of one light, emitted with smoothing 1, whose samples are two numbers: a random-access range of
    ///                  TracedPhoton
    /// @param executor  runs the fits; the field does not depend on it
    template <class Photons, class E>
    FootprintField(const Photons& photons, const FieldOptions& options, E& executor)
        : FootprintField(PathSamples(photons), options, run_by(executor)) {}

    /// Nothing where the photons say nothing: too few of them took this path.
    [[nodiscard]] std::optional<FieldSample> at(const std::array<double, 2>& sample, const EmissionFrame& frame,
                                                std::uint32_t signature) const {
        const Sheet* sheet = find(signature);
        return sheet != nullptr && sheet->field ? sheet->field->at(sample, frame) : std::nullopt;
    }

private:
    FootprintField(const PathSamples& photons, const FieldOptions& options, const TaskRunner& run) {
        const EmissionSheets sheets(photons, options.repeats, run);
        sheets_.reserve(sheets.sheets().size());
        for (const EmissionSheet& sheet : sheets.sheets()) {
            sheets_.push_back({sheet.signature, std::nullopt});
            if (double(sheet.photons.size()) >= fewest)
                sheets_.back().field.emplace(photons, sheets, sheet, options, run);
        }
    }

    static constexpr double fewest = 4 * EmissionCells::photons_per_cell;

    struct Sheet {
        std::uint32_t signature;
        std::optional<SheetField> field;
    };

    [[nodiscard]] const Sheet* find(std::uint32_t signature) const {
        const auto found = std::lower_bound(sheets_.begin(), sheets_.end(), signature,
                                            [](const Sheet& a, std::uint32_t b) { return a.signature < b; });
        return found != sheets_.end() && found->signature == signature ? &*found : nullptr;
    }

    std::vector<Sheet> sheets_; // sorted by signature
};

} // namespace nephroid::detail
