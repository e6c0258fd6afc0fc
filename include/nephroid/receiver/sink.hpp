// SPDX-License-Identifier: MIT
/// @file  A sink: receives the sums, for the renderer's film.
#pragma once

#include "nephroid/emission/flux.hpp"

#include <concepts>
#include <cstddef>

namespace nephroid {

/// `sink(vertex, value)` receives the sum at an eye path vertex, given by its index in the renderer's own array, and
/// adds it to the vertex's pixel. Called from one thread, once for each vertex.
///
/// ```cpp
/// sums.for_each([&](std::size_t vertex, const Colour& irradiance) {
///     film[vertices[vertex].pixel] += vertices[vertex].throughput * irradiance * (1 / pi);
/// });
/// ```
template <class S, class F>
concept Sink = Flux<F> && std::invocable<S&, std::size_t, const F&>;

namespace detail {
template <class S, class F>
consteval bool explain_sink() {
    static_assert(Sink<S, F>, "nephroid: the sink cannot be called as sink(std::size_t vertex, const F& value) "
                              "(receiver/sink.hpp)");
    return false;
}

template <class S, class F>
concept MustBeSink = Sink<S, F> || explain_sink<S, F>();
} // namespace detail

} // namespace nephroid
