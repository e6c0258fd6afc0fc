// SPDX-License-Identifier: MIT
/// @file  What tests with random numbers measure by: chi-square, and means with their standard errors.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::tests {

/// The distance of counts from an equal distribution, Σ (count − mean)² / mean.
[[nodiscard]] inline double chi_square(const std::vector<std::size_t>& counts) {
    double total = 0, sum = 0;
    for (const std::size_t count : counts)
        total += static_cast<double>(count);
    const double mean = total / static_cast<double>(counts.size());
    for (const std::size_t count : counts)
        sum += (static_cast<double>(count) - mean) * (static_cast<double>(count) - mean) / mean;
    return sum;
}

/// What chi-square exceeds with a probability of one in a million: Wilson and Hilferty's approximation.
[[nodiscard]] inline double chi_square_limit(std::size_t bins) {
    const double freedom = static_cast<double>(bins - 1), deviations = 4.7534;
    const double root = 1 - 2 / (9 * freedom) + deviations * std::sqrt(2 / (9 * freedom));
    return freedom * root * root * root;
}

/// A mean of independent numbers and its standard error.
class Mean {
public:
    void add(double x) {
        ++count_;
        const double difference = x - mean_;
        mean_ += difference / count_;
        squares_ += difference * (x - mean_);
    }
    [[nodiscard]] double value() const { return mean_; }
    [[nodiscard]] double error() const { return std::sqrt(squares_ / (count_ - 1) / count_); }

private:
    double count_ = 0;
    double mean_ = 0;
    double squares_ = 0;
};

} // namespace nephroid::tests
