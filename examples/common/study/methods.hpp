// SPDX-License-Identifier: MIT
/// @file  The methods that are compared: each turns photons and a bandwidth into a picture of irradiance.
#pragma once

#include <string>
#include <vector>

namespace nephroid::examples::study {

class Bench;
struct Photons;

/// Wall clock, by stage.
struct Seconds {
    double trace = 0;    ///< photons, with tangents where the method needs them
    double build = 0;    ///< the map of eye path vertices or of photons
    double estimate = 0; ///< splatting or gathering
    [[nodiscard]] double total() const { return trace + build + estimate; }
};

/// What a method made of its photons.
struct Estimate {
    std::vector<float> irradiance; ///< pixel by pixel, row 0 at the bottom
    Seconds seconds;
};

/// Where a method's photons come from.
enum class Source {
    stored, ///< those of `Photons::deposits`, for sweeps; `Seconds::trace` and the map of vertices are as measured once
    lamp    ///< the same ones traced anew, as a renderer would: for timing
};

struct Method {
    std::string id;        ///< on the command line
    std::string title;     ///< in tables and plots
    std::string source;    ///< the paper
    std::string symbol;    ///< of its bandwidth; empty for a method that has none to choose
    std::string bandwidth; ///< what that is
    bool is_whole;         ///< the bandwidth is a whole number
    double ratio;          ///< between neighbours in the finest grid of bandwidths: about a tenth of the picture's blur
    double (*expected)(const Bench&, const Photons&); ///< a bandwidth to begin with
    double (*least)(const Bench&, const Photons&);    ///< bandwidth that makes sense
    double (*most)(const Bench&, const Photons&);
    Estimate (*run)(const Bench&, const Photons&, double bandwidth, Source);
    std::string setting = {};          ///< of its second parameter, where a user would try several: "C = 0.4"
    std::vector<Method> settings = {}; ///< the same with others: tried as well, and the best of all counts
};

/// "k = 50", "h = 0.0124, C = 0.4", or "nothing to choose".
[[nodiscard]] std::string bandwidth_text(const Method& method, double bandwidth);

/// All there are, photon differential splatting first.
[[nodiscard]] const std::vector<Method>& methods();

/// Nothing for an id that is none.
[[nodiscard]] const Method* find_method(const std::string& id);

/// "splat, fixed, …"
[[nodiscard]] std::string method_names();

} // namespace nephroid::examples::study
