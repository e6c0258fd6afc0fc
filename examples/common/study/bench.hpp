// SPDX-License-Identifier: MIT
/// @file  What all methods are given alike: a case, its film and reference, the same photons and eye path vertices.
#pragma once

#include "common/builtin_film.hpp"
#include "common/errors.hpp"
#include "common/stopwatch.hpp"
#include "common/study/options.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/receiver/eye_path_map.hpp"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace nephroid::examples::study {

/// Stored photons with N tangents.
template <std::size_t N>
using Deposits = std::vector<Deposit<glm::vec3, float, N>>;

/// The photons of one sequence and count, as every method gets them.
struct Photons {
    SequenceKind sequence;
    AnySequence samples;
    std::uint64_t wanted = 0;  ///< caustic photons asked for
    std::uint64_t emitted = 0; ///< for as many caustic ones
    Deposits<2> deposits;      ///< in the order of emission; tangents for s = 1, which scale with s
    std::vector<std::size_t>
        pass_begin;                ///< index of the first deposit of each pass of progressive methods, and the end
    double trace_seconds = 0;      ///< with tangents
    double bare_trace_seconds = 0; ///< without
    mutable std::shared_ptr<struct DiffusionSweep> diffusion; ///< kept from one bandwidth to the next

    [[nodiscard]] std::size_t passes() const { return pass_begin.size() - 1; }
    /// Index of the first photon emitted in a pass; for `passes()` the number of all.
    [[nodiscard]] std::uint64_t first_of_pass(std::size_t pass) const { return emitted * pass / passes(); }
};

/// Eye path vertices, and the map of them that splatting needs.
struct FloorMap {
    explicit FloorMap(std::vector<FloorVertex> vertices_)
        : vertices(std::move(vertices_)), map(vertices, &FloorVertex::position, upwards), seconds(stopwatch_.lap()) {}

private:
    Stopwatch stopwatch_; // before the map, whose making it times

public:
    std::vector<FloorVertex> vertices;
    EyePathMap<glm::vec3> map;
    double seconds; ///< that the map took
};

class Bench {
public:
    using Case = BuiltinCase<float, float>;

    /// Throws UsageError for a case that needs a reference and gets none, std::runtime_error for a reference that
    /// cannot be read or is of another size.
    explicit Bench(const Options& options);

    [[nodiscard]] const Case& scene() const { return case_; }
    [[nodiscard]] const BuiltinFilm& film() const { return film_; }
    [[nodiscard]] const WalkLimits& limits() const { return limits_; }
    [[nodiscard]] ThreadExecutor& threads() const { return *threads_; }
    [[nodiscard]] bool is_exact() const { return !options_.reference; }
    [[nodiscard]] const std::vector<double>& reference() const { return reference_; }
    /// rms of the reference's standard errors over its mean; 0 if it is exact.
    [[nodiscard]] double reference_noise() const { return noise_; }
    /// That shows the reference well.
    [[nodiscard]] double exposure() const { return exposure_; }

    /// Traces the photons, all of them with tangents and once more without, for the time.
    [[nodiscard]] Photons trace(SequenceKind sequence, std::uint64_t wanted) const;

    /// Traces photons [first, end) of the same without tangents.
    [[nodiscard]] Deposits<0> trace_bare(const Photons& photons, std::uint64_t first, std::uint64_t end) const;

    /// The film's vertices, without ghosts: where photon maps are asked for estimates.
    [[nodiscard]] const std::vector<FloorVertex>& vertices() const { return vertices_; }

    /// The map of the vertices, with ghosts beyond a periodic floor's border; kept for the next sweep.
    /// @param margin  how far footprints reach, world units
    [[nodiscard]] const FloorMap& map(double margin) const;
    /// The vertices of that map.
    [[nodiscard]] std::vector<FloorVertex> vertices_with_ghosts(double margin) const;

    /// The photons, and their ghosts beyond a periodic floor's border.
    /// @param margin  how far estimates reach
    template <std::size_t N>
    [[nodiscard]] Deposits<N> with_ghosts(Deposits<N> deposits, double margin) const;

    /// Photons on the film per unit of its area.
    [[nodiscard]] double density(const Photons& photons) const;

    /// Of a picture; its `relative` is corrected for the reference's own noise, which would be added in quadrature.
    [[nodiscard]] Errors errors(const std::vector<float>& irradiance) const;

private:
    [[nodiscard]] static constexpr double margin_step() { return 1.0 / 16; }
    void read_reference();

    Options options_;
    Case case_;
    BuiltinFilm film_;
    WalkLimits limits_;
    std::unique_ptr<ThreadExecutor> threads_;
    std::vector<FloorVertex> vertices_;
    std::vector<double> reference_;
    double noise_ = 0, exposure_ = 1;
    mutable std::map<int, std::unique_ptr<FloorMap>> maps_; ///< by margin, in steps
};

template <std::size_t N>
Deposits<N> Bench::with_ghosts(Deposits<N> deposits, double margin) const {
    if (!case_.periodic)
        return deposits;
    const float reach = static_cast<float>((std::min)(margin, 1.0));
    const auto is_near = [&](float coordinate) { return coordinate >= -reach && coordinate <= 1 + reach; };
    const std::size_t count = deposits.size();
    for (std::size_t i = 0; i < count; ++i)
        for (const float y : {-1.f, 0.f, 1.f})
            for (const float x : {-1.f, 0.f, 1.f}) {
                auto ghost = deposits[i];
                ghost.position += glm::vec3(x, y, 0);
                if ((x != 0 || y != 0) && is_near(ghost.position.x) && is_near(ghost.position.y))
                    deposits.push_back(ghost);
            }
    return deposits;
}

} // namespace nephroid::examples::study
