// SPDX-License-Identifier: MIT
/// @file  Accumulators: of what numbers the sums are made. Flux itself, doubles, or whole numbers, which are the same
///        bits in any order of photons, threads and ranks.
#pragma once

#include "nephroid/receiver/flux_bands.hpp"
#include "nephroid/receiver/response.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace nephroid {

/// Sums in double: `sums<F>(map, InDouble{})`. Ranks then agree to some 1e-15 instead of 1e-7.
///
/// @tparam R  Irradiance, or another Response
template <class R = Irradiance>
struct InDouble {
    R response;

    explicit InDouble(R to = {}) : response(std::move(to)) {}
};

/// Sums in whole numbers: each photon's part at a vertex is rounded once, to a multiple of a unit. Their sum is then
/// the same, bit for bit, in whatever order and on however many ranks it was made.
///
/// ```cpp
/// auto sums = nephroid::sums<float>(map, nephroid::InWholeNumbers(lamp.power()));
/// ```
///
/// @tparam R  Irradiance, or another Response
template <class R = Irradiance>
struct InWholeNumbers {
    double power; ///< > 0: of all lamps together, in the brightest band, times the largest response. The unit is
        ///< power / diagonal² · 2⁻⁴⁰ or, for more than 16,383 slots, as much larger as leaves room for all
        ///< light at one vertex
    R response;

    explicit InWholeNumbers(double of_lamps, R to = {}) : power(of_lamps), response(std::move(to)) {}
};

namespace detail {

/// Sums of the flux's own type.
template <class F, class R>
class Accumulator {
public:
    using number = F;
    static constexpr std::size_t numbers = 1;
    static constexpr bool is_flux = true;

    Accumulator(R response, std::size_t, double) : response_(std::move(response)) {}

    [[nodiscard]] const R& response() const { return response_; }
    [[nodiscard]] static F zero() { return flux_traits<F>::zero(); }
    [[nodiscard]] const F& value(const F* at) const { return *at; }
    void add(F* to, const F& more) const { *to = *to + more; }
    static void merge(F& to, const F& more) { to = to + more; }

private:
    [[no_unique_address]] R response_;
};

template <MustHaveBands F, class R>
class Accumulator<F, InDouble<R>> {
public:
    using number = double;
    static constexpr std::size_t numbers = flux_bands<F>::count;
    static constexpr bool is_flux = false;

    Accumulator(InDouble<R> options, std::size_t, double) : response_(std::move(options.response)) {}

    [[nodiscard]] const R& response() const { return response_; }
    [[nodiscard]] static double zero() { return 0; }
    [[nodiscard]] F value(const double* at) const {
        std::array<double, numbers> bands;
        std::copy(at, at + numbers, bands.begin());
        return flux_bands<F>::flux(bands);
    }
    void add(double* to, const F& more) const {
        const std::array<double, numbers> bands = flux_bands<F>::of(more);
        for (std::size_t band = 0; band < numbers; ++band)
            to[band] += bands[band];
    }
    static void merge(double& to, double more) { to += more; }

private:
    [[no_unique_address]] R response_;
};

/// A sum that reaches the limit stays there. As the limit is 2⁵⁶, 127 ranks may add their sums without such a
/// check, as MPI_SUM does, and what was beyond the limit still is.
template <MustHaveBands F, class R>
class Accumulator<F, InWholeNumbers<R>> {
public:
    using number = std::int64_t;
    static constexpr std::size_t numbers = flux_bands<F>::count;
    static constexpr bool is_flux = false;
    static constexpr std::int64_t limit = std::int64_t(1) << 56;

    /// @param vertices  at least those of the receiver
    Accumulator(InWholeNumbers<R> options, std::size_t vertices, double diagonal)
        : response_(std::move(options.response)) {
        if (!(options.power > 0) || !std::isfinite(options.power))
            invalid_argument("nephroid::InWholeNumbers: power is " + text_of(options.power) +
                             "; it must be that of all lamps together, positive and finite");
        int of_power = 0, of_area = 0, of_vertices = 0;
        std::frexp(options.power, &of_power);
        std::frexp(diagonal > 0 ? diagonal * diagonal : 1.0, &of_area); // a single vertex has none
        std::frexp(double(vertices), &of_vertices);
        const int exponent = of_power - of_area - (std::min)(40, 54 - of_vertices);
        unit_ = std::ldexp(1.0, exponent);
        per_unit_ = std::ldexp(1.0, -exponent);
    }

    [[nodiscard]] const R& response() const { return response_; }
    [[nodiscard]] static std::int64_t zero() { return 0; }
    [[nodiscard]] F value(const std::int64_t* at) const {
        std::array<double, numbers> bands;
        for (std::size_t band = 0; band < numbers; ++band)
            bands[band] = double(std::clamp(at[band], -limit, limit)) * unit_;
        return flux_bands<F>::flux(bands);
    }
    void add(std::int64_t* to, const F& more) const {
        const std::array<double, numbers> bands = flux_bands<F>::of(more);
        for (std::size_t band = 0; band < numbers; ++band)
            merge(to[band], whole(bands[band] * per_unit_));
    }
    static void merge(std::int64_t& to, std::int64_t more) {
        if (to > -limit && to < limit)
            to = std::clamp(to + std::clamp(more, -limit, limit), -limit, limit);
    }
    [[nodiscard]] double unit() const { return unit_; }
    [[nodiscard]] bool has_overflowed(const std::int64_t* at) const {
        return std::any_of(at, at + numbers, [](std::int64_t sum) { return sum <= -limit || sum >= limit; });
    }

private:
    /// The nearest whole number. What is no number, or beyond the limit, is the limit: it shows as an overflow.
    [[nodiscard]] static std::int64_t whole(double value) {
        if (!(std::abs(value) < double(limit)))
            return value < 0 ? -limit : limit;
        return std::int64_t(value + (value < 0 ? -0.5 : 0.5));
    }

    [[no_unique_address]] R response_;
    double unit_ = 1, per_unit_ = 1;
};

/// The response within a response or an accumulator of one.
template <class R>
struct ResponseWithin {
    using type = R;
};
template <class R>
struct ResponseWithin<InDouble<R>> {
    using type = R;
};
template <class R>
struct ResponseWithin<InWholeNumbers<R>> {
    using type = R;
};
template <class R>
using response_within = typename ResponseWithin<R>::type;

} // namespace detail
} // namespace nephroid
