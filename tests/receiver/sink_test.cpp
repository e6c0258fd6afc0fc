// SPDX-License-Identifier: MIT
#include "nephroid/receiver/sink.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::sink_test {

namespace {

struct Film {
    std::vector<float> pixels;
    void operator()(std::size_t vertex, float value) { pixels[vertex] += value; }
};

struct TakesText {
    void operator()(std::size_t, const char*) const {}
};

} // namespace

static_assert(Sink<Film, float>);
static_assert(!Sink<TakesText, float>);
static_assert(!Sink<int, float>);
static_assert(!Sink<Film, int*>);
static_assert(!Sink<Film, glm::vec3>); // a grey film does not take colours

TEST_CASE("sink: a film takes a value for each vertex") {
    Film film{{0, 0}};
    film(1, 2.5f);
    CHECK(film.pixels[1] == 2.5f);
}

} // namespace nephroid::tests::sink_test
