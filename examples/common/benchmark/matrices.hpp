// SPDX-License-Identifier: MIT
/// @file  The filter matrix against inverting the matrix [a b n], of which it is the upper two rows.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/table.hpp"

#include "nephroid/emission/sequence/random.hpp"
#include "nephroid/emission/sequence/sequence.hpp"
#include "nephroid/footprint/ellipse.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace nephroid::examples::benchmarks {

/// The inverse of a matrix by elimination with partial pivoting, as for a matrix of any size and kind.
template <class T>
[[nodiscard]] glm::mat<3, 3, T> general_inverse(glm::mat<3, 3, T> m) {
    glm::mat<3, 3, T> inverse(1);
    for (int column = 0; column < 3; ++column) {
        int pivot = column;
        for (int row = column + 1; row < 3; ++row)
            if (std::abs(m[row][column]) > std::abs(m[pivot][column]))
                pivot = row;
        std::swap(m[column], m[pivot]);
        std::swap(inverse[column], inverse[pivot]);
        const T scale = 1 / m[column][column];
        m[column] *= scale;
        inverse[column] *= scale;
        for (int row = 0; row < 3; ++row) {
            if (row == column)
                continue;
            const T factor = m[row][column];
            m[row] -= factor * m[column];
            inverse[row] -= factor * inverse[column];
        }
    }
    return inverse;
}

template <class T>
void benchmark_matrices_of(const Effort& effort, const char* scalar) {
    using V = glm::vec<3, T>;
    using M = glm::mat<3, 3, T>;
    constexpr std::size_t count = 1024;
    std::vector<Ellipse<V>> ellipses;
    const RandomSequence sequence(3);
    for (std::size_t i = 0; i < count; ++i) {
        Sampler<RandomSequence> draw(sequence, i);
        const auto number = [&] { return T(2) * draw.template next<T>() - T(1); };
        const V n = normalize(V(number(), number(), T(1.5)));
        const Frame<V> frame = frame_about(n);
        const T a = number(), b = number(), c = number(), d = number();
        ellipses.push_back({a * frame.u + b * frame.v, c * frame.u + d * frame.v, n});
    }
    std::vector<FilterMatrix<V>> rows(count);
    const auto each = [&](const auto& invert) {
        return [&rows, &ellipses, invert] {
            for (std::size_t i = 0; i < count; ++i)
                rows[i] = invert(ellipses[i]);
            benchmark::DoNotOptimize(rows.data());
            benchmark::ClobberMemory();
        };
    };
    const auto upper_rows = [](const M& m) { // of the inverse; glm's columns are what a matrix's rows are here
        return FilterMatrix<V>{V(m[0][0], m[1][0], m[2][0]), V(m[0][1], m[1][1], m[2][1])};
    };
    const auto ours = each([](const Ellipse<V>& e) { return filter_matrix(e); });
    const auto cofactors = each([=](const Ellipse<V>& e) { return upper_rows(glm::inverse(M(e.a, e.b, e.normal))); });
    const auto general = each([=](const Ellipse<V>& e) { return upper_rows(general_inverse(M(e.a, e.b, e.normal))); });

    // One at a time: the next has to wait for the one before.
    V chained(0);
    const auto chain = [&](const auto& invert) {
        return [&ellipses, &chained, invert] {
            V last(0);
            for (std::size_t i = 0; i < count; ++i) {
                Ellipse<V> e = ellipses[i];
                e.a += T(1e-30) * last;
                last = invert(e).row_a;
            }
            chained = last;
            benchmark::DoNotOptimize(chained);
        };
    };
    const auto ours_chained = chain([](const Ellipse<V>& e) { return filter_matrix(e); });
    const auto cofactors_chained =
        chain([=](const Ellipse<V>& e) { return upper_rows(glm::inverse(M(e.a, e.b, e.normal))); });
    const auto general_chained =
        chain([=](const Ellipse<V>& e) { return upper_rows(general_inverse(M(e.a, e.b, e.normal))); });

    const double items = double(count);
    const auto t = seconds_per_item(effort, {{items, ours},
                                             {items, cofactors},
                                             {items, general},
                                             {items, ours_chained},
                                             {items, cofactors_chained},
                                             {items, general_chained}});
    const std::string what = std::string("filter matrix, ") + scalar;
    print_row(what + ", one at a time", 1e9 * t[3], "ns", "glm::inverse", t[4] / t[3], Bar::at_least(2));
    print_row(what + ", one at a time", 1e9 * t[3], "ns", "elimination with pivots", t[5] / t[3], Bar::at_least(13.6));
    print_row(what + ", in batch", 1e9 * t[0], "ns", "glm::inverse", t[1] / t[0]);
    print_row(what + ", in batch", 1e9 * t[0], "ns", "elimination with pivots", t[2] / t[0]);
}

inline void benchmark_matrices(const Effort& effort) {
    benchmark_matrices_of<float>(effort, "float");
    benchmark_matrices_of<double>(effort, "double");
}

} // namespace nephroid::examples::benchmarks
