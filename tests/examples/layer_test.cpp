// SPDX-License-Identifier: MIT
#include "common/layer.hpp"

#include <doctest/doctest.h>

#include <string>

namespace nephroid::examples::layer_test {

TEST_CASE("layer: bounces are a number or all, and no more than all") {
    CHECK(bounces_in("0") == 0);
    CHECK(bounces_in("3") == 3);
    CHECK(bounces_in("all") == all_bounces);
    CHECK(bounces_in("1e9") == all_bounces);
    for (const char* wrong : {"", "some", "-1", "1.5", "nan"}) {
        std::string message;
        try {
            static_cast<void>(bounces_in(wrong));
        } catch (const UsageError& error) {
            message = error.what();
        }
        CHECK(message.find("--bounces") != std::string::npos);
    }
}

TEST_CASE("layer: each has a name of its own") {
    for (const Layer layer : {Layer::all, Layer::caustics, Layer::direct, Layer::indirect})
        CHECK(chosen("--layer", name_in(layer_names(), layer), layer_names()) == layer);
    CHECK(layer_names().size() == 4);
}

} // namespace nephroid::examples::layer_test
