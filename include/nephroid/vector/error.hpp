// SPDX-License-Identifier: MIT
/// @file  Reports a wrong call, with and without exceptions.
#pragma once

#include "nephroid/vector/language.hpp"

#include <cstdlib>
#include <string>

#if defined(__cpp_exceptions)
#include <stdexcept>
#endif

/// Keeps functions that check arguments out of line, so that they do not lengthen their callers.
#if defined(__GNUC__)
#define NEPHROID_NOINLINE __attribute__((noinline))
#else
#define NEPHROID_NOINLINE
#endif

namespace nephroid {

/// A function that receives the message under `-fno-exceptions`. It must not return; if it does, the program aborts.
/// Renderers set their own (log, longjmp, assert); the default aborts.
using ErrorHandler = void (*)(const char* message);

/// The process's handler; assign it before the first call into the library. Not used where exceptions are on.
inline ErrorHandler error_handler = [](const char*) { std::abort(); };

/// Reports an argument that only a wrong call or a broken scene can cause.
///
/// @param message  "nephroid::function: what the value was, and what to do"
/// Throws std::invalid_argument with that message, or calls `error_handler` with it under `-fno-exceptions`. All files
/// of one program that include the library must agree in this respect.
[[noreturn]] NEPHROID_NOINLINE inline void invalid_argument(const std::string& message) {
#if defined(__cpp_exceptions)
    throw std::invalid_argument(message);
#else
    error_handler(message.c_str());
    std::abort();
#endif
}

} // namespace nephroid
