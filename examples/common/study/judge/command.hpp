// SPDX-License-Identifier: MIT
/// @file  `study judge`: the default against the published method on scenes from seeds.
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace nephroid::examples::study::judge {

class Command {
public:
    /// Adds the options to the subcommand's app, which must not live longer.
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// Throws UsageError.
    void run() const;

private:
    std::string photons_ = "5000,20000,200000", kinds_, lamps_, sequence_ = "halton", format_ = "text";
    std::uint64_t seed_ = 11, seeds_ = 1, truth_ = 2'000'000;
    unsigned size_ = 128, threads_ = 1;
    bool best_ = false;
};

} // namespace nephroid::examples::study::judge
