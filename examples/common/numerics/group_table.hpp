// SPDX-License-Identifier: MIT
/// @file  Runs and measures a group's cases: the error of the library's tangents against the oracle's, in units of the
///        problem's condition times the machine epsilon.
#pragma once

#include "common/numerics/cases.hpp"
#include "common/numerics/library.hpp"

#include <limits>
#include <string>
#include <vector>

namespace nephroid::examples::numerics {

/// One case. The determinant of the footprint counts as a result beside the four derivatives.
struct Measured {
    Chain chain;
    std::uint32_t number = 0;  ///< index in the generator's sequence
    double relative_error = 0; ///< the largest of the four derivatives
    double condition = 0;      ///< the largest of the four: relative change over relative change
    double units = 0;          ///< the largest of the five: error / (condition × epsilon), absolute both
    double oracle_units = 0;   ///< the oracle's own estimated error, in the same units
    const char* what = "";     ///< the derivative with that error
};

struct Row {
    Group group = Group::ordinary;
    std::vector<Measured> cases;
    std::size_t ill_posed = 0; ///< other cases, in which the rounding of the input alone changes the result by 1%, or
                               ///< changes the path's course; these must only give finite numbers
    std::size_t lost = 0;      ///< well-posed cases whose photon did not arrive
    std::size_t lost_ill_posed = 0;
    std::size_t not_finite = 0; ///< of all cases
    double emitted = 0, accounted = 0;

    [[nodiscard]] double median(double Measured::*column) const { return quantile(column, 0.5); }
    [[nodiscard]] double largest(double Measured::*column) const { return quantile(column, 1); }
    [[nodiscard]] double quantile(double Measured::*column, double share) const {
        if (cases.empty())
            return 0;
        std::vector<double> values;
        for (const Measured& m : cases)
            values.push_back(m.*column);
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(share * double(values.size() - 1))];
    }
};

inline constexpr std::array<const char*, 5> result_names = {"dx/du", "dx/dv", "dw/du", "dw/dv", "determinant"};

[[nodiscard]] inline bool are_finite(const Tangents& t) {
    return is_finite(t[0]) && is_finite(t[1]) && is_finite(t[2]) && is_finite(t[3]);
}

/// @param count  of well-posed cases that are wanted
template <class T>
[[nodiscard]] Row measure(Group group, std::size_t count, std::uint32_t seed = 2024) {
    constexpr double epsilon = double(std::numeric_limits<T>::epsilon());
    constexpr double most_effect = 1.0 / 128;
    Row row;
    row.group = group;
    Generator<T> generator(group, seed + 7919u * static_cast<std::uint32_t>(group));
    for (std::uint32_t number = 0; row.cases.size() < count && number < 200 * count; ++number) {
        const std::optional<Chain> chain = generator.next();
        if (!chain)
            continue;
        const Truth truth = differentiate(*chain);
        const Sensitivity moves = sensitivity(*chain, truth.normal);
        // A walk starts rays up to 48 roundings off a surface, so a case that this decides is not well posed.
        bool well_posed = keeps_course(*chain, 48 * epsilon);
        for (std::size_t i = 0; i < Tangents::size; ++i)
            well_posed =
                well_posed && epsilon * moves.of[i] <= most_effect * truth.tangents[i].length() + truth.error[i];

        Statistics account;
        const auto outcome = run_library<T>(*chain, account);
        row.emitted += account.emitted.flux;
        row.accounted += account.accounted_flux();
        if (outcome)
            row.not_finite += !are_finite(outcome->tangents);
        if (!well_posed) {
            ++row.ill_posed;
            row.lost_ill_posed += !outcome;
            continue;
        }
        if (!outcome) {
            ++row.lost;
            continue;
        }

        Measured m;
        m.chain = *chain;
        m.number = number;
        const auto count_in = [&](double error, double oracle_error, double size, double movement, std::size_t what) {
            const double unit = epsilon * (movement + size);
            const double units = error > oracle_error ? (error - oracle_error) / unit : 0;
            if (!(units <= m.units))
                m.units = units, m.what = result_names[what];
            if (unit > 0)
                m.oracle_units = (std::max)(m.oracle_units, oracle_error / unit);
        };
        for (std::size_t i = 0; i < Tangents::size; ++i) {
            const double size = truth.tangents[i].length(), error = (outcome->tangents[i] - truth.tangents[i]).length();
            count_in(error, truth.error[i], size, moves.of[i], i);
            if (size > 0) {
                m.relative_error = (std::max)(m.relative_error, error / size);
                m.condition = (std::max)(m.condition, moves.of[i] / size);
            }
        }
        const Tangents& t = truth.tangents;
        const double exact = std::abs(determinant(t, truth.normal));
        const double oracle_error = truth.error[0] * t[1].length() + truth.error[1] * t[0].length();
        count_in(std::abs(std::abs(outcome->determinant) - exact), oracle_error, exact, moves.determinant, 4);
        row.cases.push_back(std::move(m));
    }
    return row;
}

} // namespace nephroid::examples::numerics
