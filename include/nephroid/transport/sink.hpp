// SPDX-License-Identifier: MIT
/// @file  Where sums go: the renderer's film.
#pragma once

#include "nephroid/emission/flux.hpp"

#include <concepts>
#include <cstddef>

namespace nephroid {

/// `sink(vertex, value)`: takes what has been summed up at an eye path vertex, by the index in the renderer's own array,
/// and adds it to the vertex's pixel. Called from one thread, once for each vertex.
template <class S, class F>
concept Sink = Flux<F> && std::invocable<S&, std::size_t, const F&>;

} // namespace nephroid
