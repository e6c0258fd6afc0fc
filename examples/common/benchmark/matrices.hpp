// SPDX-License-Identifier: MIT
/// @file  Compares `filter_matrix` with inverting the whole matrix [a b n]; both give the upper two rows of the
///        inverse.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/table.hpp"

#include "nephroid/footprint/ellipse.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <type_traits>
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

/// Inverts independent matrices, as for photons, so that the processor can work on several at once. The whole result is
/// stored, so that the compiler cannot leave out a row that is not used.
template <class V, class Invert>
class EachAlone {
public:
    EachAlone(const std::vector<Ellipse<V>>& ellipses, Invert invert)
        : ellipses_(&ellipses), results_(ellipses.size()), invert_(invert) {}
    void operator()() {
        for (std::size_t i = 0; i < ellipses_->size(); ++i)
            results_[i] = invert_((*ellipses_)[i]);
        benchmark::DoNotOptimize(results_.data());
        benchmark::ClobberMemory();
    }

private:
    const std::vector<Ellipse<V>>* ellipses_;
    std::vector<std::invoke_result_t<Invert, const Ellipse<V>&>> results_;
    Invert invert_;
};

/// Inverts dependent matrices: each one starts from the result before it, and so has to wait. The other rows are added
/// up.
template <class V, class Invert>
class OneByOne {
public:
    OneByOne(const std::vector<Ellipse<V>>& ellipses, Invert invert) : ellipses_(&ellipses), invert_(invert) {}
    void operator()() const {
        using T = scalar_t<V>;
        V last(0), second(0), third(0);
        for (Ellipse<V> e : *ellipses_) {
            e.a += T(1e-30) * last;
            const auto m = invert_(e);
            if constexpr (std::is_same_v<decltype(m), const FilterMatrix<V>>) {
                last = m.row_a;
                second += m.row_b;
            } else {
                last = V(m[0][0], m[1][0], m[2][0]);
                second += V(m[0][1], m[1][1], m[2][1]);
                third += V(m[0][2], m[1][2], m[2][2]);
            }
        }
        const V sum = last + second + third;
        benchmark::DoNotOptimize(sum);
    }

private:
    const std::vector<Ellipse<V>>* ellipses_;
    Invert invert_;
};

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
    const auto rows_of = [](const Ellipse<V>& e) { return filter_matrix(e); };
    const auto cofactors_of = [](const Ellipse<V>& e) { return glm::inverse(M(e.a, e.b, e.normal)); };
    const auto elimination_of = [](const Ellipse<V>& e) { return general_inverse(M(e.a, e.b, e.normal)); };
    const auto upper_rows_of = [=](const Ellipse<V>& e) { // glm's columns are what a matrix's rows are here
        const M m = cofactors_of(e);
        return FilterMatrix<V>{V(m[0][0], m[1][0], m[2][0]), V(m[0][1], m[1][1], m[2][1])};
    };
    const std::vector<Task> tasks = {
        {double(count), EachAlone(ellipses, rows_of)},       {double(count), EachAlone(ellipses, cofactors_of)},
        {double(count), EachAlone(ellipses, upper_rows_of)}, {double(count), EachAlone(ellipses, elimination_of)},
        {double(count), OneByOne(ellipses, rows_of)},        {double(count), OneByOne(ellipses, cofactors_of)},
        {double(count), OneByOne(ellipses, elimination_of)},
    };
    const auto t = seconds_per_item(effort, tasks);
    const std::string what = std::string("filter matrix, ") + scalar;
    print_row(what + ", in batch", 1e9 * t[0], "ns", "glm::inverse", t[1] / t[0], Bar::at_least(2));
    print_row(what + ", in batch", 1e9 * t[0], "ns", "the two rows of glm::inverse", t[2] / t[0]);
    print_row(what + ", in batch", 1e9 * t[0], "ns", "elimination with pivots", t[3] / t[0], Bar::at_least(13.6));
    print_row(what + ", one after another", 1e9 * t[4], "ns", "glm::inverse", t[5] / t[4], Bar::at_least(2));
    print_row(what + ", one after another", 1e9 * t[4], "ns", "elimination with pivots", t[6] / t[4],
              Bar::at_least(13.6));
}

inline void benchmark_matrices(const Effort& effort) {
    benchmark_matrices_of<float>(effort, "float");
    benchmark_matrices_of<double>(effort, "double");
}

} // namespace nephroid::examples::benchmarks
