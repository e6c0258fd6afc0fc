// SPDX-License-Identifier: MIT
#include "nephroid/vector/error.hpp"

#include <doctest/doctest.h>

#include <string>

namespace nephroid::tests::error_test {

#if defined(__cpp_exceptions)

TEST_CASE("invalid_argument: throws std::invalid_argument with the message as it was given") {
    const std::string message = "nephroid::function: the value was 3% of \"it\", \xC3\xA9";
    CHECK_THROWS_WITH_AS(nephroid::invalid_argument(message), message.c_str(), std::invalid_argument);
    CHECK_THROWS_WITH_AS(nephroid::invalid_argument(""), "", std::invalid_argument);
}

#else
#include <csetjmp>

namespace {
std::jmp_buf back;
std::string heard;
} // namespace

TEST_CASE("invalid_argument: without exceptions the message goes to the handler in force") {
    const std::string message = "nephroid::function: the value was 3";
    const nephroid::ErrorHandler before = nephroid::error_handler;
    nephroid::error_handler = [](const char* text) {
        heard = text;
        std::longjmp(back, 1); // no object with a destructor lies between here and setjmp
    };
    if (setjmp(back) == 0)
        nephroid::invalid_argument(message);
    CHECK(heard == message);
    nephroid::error_handler = before;
}

#endif

TEST_CASE("error_handler: is there from the start") {
    const bool there = nephroid::error_handler != nullptr;
    CHECK(there);
}

} // namespace nephroid::tests::error_test
