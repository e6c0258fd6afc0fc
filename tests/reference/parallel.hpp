// SPDX-License-Identifier: MIT
/// @file  A loop over independent items, shared out among threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace nephroid::reference::detail {

/// Calls `body(item)` once for each item in 0 to count - 1, in no particular order and from several threads.
///
/// Items that write to places of their own give the same bits for every number of threads.
/// @param threads  how many to use; 0 for one per core
/// Rethrows one of the exceptions that `body` threw, after all threads have ended.
template <class Body>
void for_each_item(int count, unsigned threads, const Body& body) {
    if (threads == 0)
        threads = (std::max)(1U, std::thread::hardware_concurrency());
    threads = (std::min)(threads, static_cast<unsigned>((std::max)(1, count)));

    std::atomic<int> next{0};
    std::exception_ptr error;
    std::mutex error_mutex;
    const auto work = [&] {
        try {
            for (int item = next++; item < count; item = next++)
                body(item);
        } catch (...) {
            const std::lock_guard<std::mutex> lock(error_mutex);
            error = std::current_exception();
        }
    };

    std::vector<std::thread> helpers;
    for (unsigned t = 1; t < threads; ++t)
        helpers.emplace_back(work);
    work();
    for (std::thread& helper : helpers)
        helper.join();
    if (error)
        std::rethrow_exception(error);
}

} // namespace nephroid::reference::detail
