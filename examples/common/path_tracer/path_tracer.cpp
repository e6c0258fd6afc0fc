// SPDX-License-Identifier: MIT
#include "common/path_tracer/path_tracer.hpp"

#include "nephroid/sequence/sequence.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <variant>

namespace nephroid::examples {

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void refuse(const std::string& what) { invalid_argument("path_trace_reference: " + what); }

/// Whether a part is made of glass that light bends in, or has triangles of it.
[[nodiscard]] bool is_of_glass(const Scene<double, double>& scene, std::size_t part) {
    const auto bends = [&](std::size_t material) { return scene.materials()[material].surface == Surface::dielectric; };
    const auto* mesh = std::get_if<TriangleMesh<double>>(&scene.parts()[part].shape);
    if (!mesh)
        return bends(scene.parts()[part].material);
    for (std::size_t i = 0; i < mesh->data().triangles.size(); ++i)
        if (bends(mesh->material(i)))
            return true;
    return false;
}

/// A path here takes its medium from the surface at its end alone (SpecularPaths), so that glass in glass, and glass
/// that touches other glass, would bend light as if there were air between.
void check_media(const Scene<double, double>& scene) {
    const auto overlap = [](const Box<double>& a, const Box<double>& b) {
        bool apart = false;
        for (int axis = 0; axis < 3; ++axis)
            apart = apart || a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis];
        return !apart;
    };
    for (std::size_t i = 0; i < scene.parts().size(); ++i)
        for (std::size_t j = i + 1; j < scene.parts().size(); ++j)
            if (is_of_glass(scene, i) && is_of_glass(scene, j) &&
                overlap(scene.bounds_of(scene.parts()[i]), scene.bounds_of(scene.parts()[j])))
                refuse("the bounds of parts " + std::to_string(i) + " and " + std::to_string(j) +
                       " overlap, and both are of glass; paths do not know which is inside the other. Move them apart");
}

void check(const BuiltinCase<double, double>& builtin, std::size_t width, std::size_t height,
           const PathTraceOptions& options) {
    const FilmRectangle& film = builtin.film;
    check_media(builtin.scene);
    if (builtin.emitters.empty() || builtin.emitters.size() != builtin.light.lights().size())
        refuse("a light has no area, and paths from the floor meet none that has not; pass a disk or a sphere");
    for (const double bound : {film.x_min, film.x_max, film.y_min, film.y_max})
        if (!std::isfinite(bound))
            refuse("the film's bound " + nephroid::detail::text_of(bound) + " is not finite");
    if (!(film.x_min < film.x_max) || !(film.y_min < film.y_max))
        refuse("the film is empty; its lower bounds must be below its upper ones");
    for (const std::size_t size : {width, height})
        if (size < 1 || size > 32768)
            refuse("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels; pass 1 to 32768 a side");
    if (options.samples < 1)
        refuse("0 samples; pass at least 1");
    if (options.samples_per_pass < 4 || options.samples_per_pass > 65536)
        refuse(std::to_string(options.samples_per_pass) + " samples a pass; pass 4 to 65536");
    if (options.pilot < 1 || options.pilot > 65536)
        refuse("a pilot of " + std::to_string(options.pilot) + " paths; pass 1 to 65536");
    if (!(options.seconds >= 0))
        refuse("a limit of " + nephroid::detail::text_of(options.seconds) + " seconds; pass 0 or more");
}

/// The numbers of directions drawn from each density.
struct Shares {
    unsigned light, halo, specular, uniform;

    /// @param wary  how many of the samples look where no light has been seen, >= 1. Half of these look close to known
    ///              light, an eighth anywhere
    Shares(unsigned samples, unsigned wary, bool has_light, bool has_halo, bool has_specular)
        : light(has_light ? samples - wary : 0), halo(has_halo ? wary / 2 : 0),
          specular(has_specular ? (wary - halo) - (wary + 7) / 8 : 0), uniform(wary - halo - specular) {}

    [[nodiscard]] unsigned total() const { return light + halo + specular + uniform; }
};

/// The densities of directions for one block's pixels, added up.
class Mixture {
public:
    /// @param samples,wary  for each pixel, see `Shares`
    Mixture(const Guidance& guidance, std::size_t block, std::size_t tile, unsigned samples, unsigned wary)
        : coarse_(guidance.coarse), fine_(guidance.fine), light_(guidance.light[block]), halo_(guidance.halo[tile]),
          specular_(guidance.specular[tile]),
          shares_(samples, wary, !light_.empty(), !halo_.empty(), !specular_.empty()) {}

    [[nodiscard]] unsigned samples() const { return shares_.total(); }

    struct Choice {
        double u, v;        ///< in the unit square of directions
        double density;     ///< of all samples together, over the square
        std::uint32_t cell; ///< of the fine grid
        bool expected;      ///< whether light has been seen in the cell, or next to it
    };

    /// The i-th of the samples.
    /// @param shift  in [0, 1), the same for all samples of a pixel: along the lists of cells they are evenly spaced
    /// @param a,b    in [0, 1): where in the cell
    [[nodiscard]] Choice choose(unsigned i, double shift, double a, double b) const {
        if (i < shares_.light) {
            const Guide::Choice chosen = light_.choose((i + shift) / shares_.light);
            return at(fine_.point_in(chosen.cell, a, b), chosen.cell, chosen.share);
        }
        i -= shares_.light;
        std::array<double, 2> place{a, b};
        if (i < shares_.halo)
            place = coarse_.point_in(halo_.choose((i + shift) / shares_.halo), a, b);
        else if (i - shares_.halo < shares_.specular)
            place = coarse_.point_in(specular_.choose((i - shares_.halo + shift) / shares_.specular), a, b);
        const std::uint32_t cell = fine_.cell_at(place[0], place[1]);
        return at(place, cell, light_.share(cell));
    }

private:
    [[nodiscard]] Choice at(const std::array<double, 2>& place, std::uint32_t cell, double share) const {
        const std::uint32_t around = fine_.cell_in(coarse_, cell);
        const auto density_over = [&](const CellSet& cells, unsigned count) {
            const bool covers = count > 0 && cells.contains(around);
            return covers ? double(count) * coarse_.cells() / double(cells.size()) : 0;
        };
        const double density = shares_.uniform + shares_.light * share * fine_.cells() +
                               density_over(halo_, shares_.halo) + density_over(specular_, shares_.specular);
        return {place[0], place[1], density, cell, share > 0};
    }

    const DirectionGrid& coarse_;
    const DirectionGrid& fine_;
    const Guide& light_;
    const CellSet& halo_;
    const CellSet& specular_;
    Shares shares_;
};

class PathTracer {
public:
    PathTracer(const BuiltinCase<double, double>& builtin, std::size_t width, std::size_t height,
               const PathTraceOptions& options, const AnyExecutor& executor)
        : builtin_(builtin), options_(options), executor_(executor), layout_(builtin.film, width, height),
          paths_(builtin.scene, builtin.emitters, options.specular_events), surprises_(layout_.blocks()),
          deviation2_(layout_.pixels()) {
        result_.mean.resize(layout_.pixels());
        result_.standard_error.resize(layout_.pixels(), std::numeric_limits<double>::infinity());
    }

    [[nodiscard]] PathTracedReference render(const PathTraceProgress& progress) {
        const Clock::time_point start = Clock::now();
        guidance_ = explore(builtin_, layout_, {options_.pilot, options_.specular_events, hash_bits(options_.seed, 0)},
                            executor_);
        const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
        for (unsigned i = 0; i < options_.rehearsals; ++i)
            pass(i, options_.samples_per_pass, [](std::size_t, double) {});
        while (result_.samples < options_.samples && (passes_ < 2 || seconds() < options_.seconds)) {
            ++passes_;
            pass(options_.rehearsals + passes_, options_.samples_per_pass / 4,
                 [this](std::size_t pixel, double irradiance) { add(pixel, irradiance); });
            result_.samples += options_.samples_per_pass;
            if (progress && !progress(result_))
                break;
        }
        return std::move(result_);
    }

private:
    /// Calls sink(pixel, irradiance) with an estimate for each pixel.
    ///
    /// @param number  of the pass
    /// @param wary    see `Shares`
    template <class Sink>
    void pass(std::uint64_t number, unsigned wary, const Sink& sink) {
        executor_(layout_.blocks(), [&](std::size_t block) {
            const Mixture mixture(guidance_, block, layout_.tile_of(block), options_.samples_per_pass, wary);
            surprises_[block].clear();
            layout_.for_pixels_of(block, [&](std::size_t pixel) {
                const RandomSequence numbers(hash_bits(hash_bits(hash_bits(options_.seed, 1), pixel), number));
                sink(pixel, estimate(pixel, mixture, numbers, surprises_[block]));
            });
        });
        executor_(layout_.blocks(), [this](std::size_t block) { learn(block); });
    }

    /// Adds the surprises of this block and its neighbours to the guide for the next passes. Their estimates stay
    /// unbiased, whatever earlier passes saw.
    void learn(std::size_t block) {
        Cells news = surprises_[block];
        layout_.for_neighbours_of(block, [&](std::size_t other) {
            news.insert(news.end(), surprises_[other].begin(), surprises_[other].end());
        });
        if (!news.empty())
            guidance_.light[block].add(grown(guidance_.fine, news));
    }

    /// @param surprises  gets the cells in which light was seen unexpectedly
    [[nodiscard]] double estimate(std::size_t pixel, const Mixture& mixture, const RandomSequence& numbers,
                                  Cells& surprises) const {
        const FilmRectangle area = layout_.pixel(pixel);
        Sampler<RandomSequence> shifts(numbers, 0);
        const double shift = shifts.next<double>(), x = shifts.next<double>(), y = shifts.next<double>();
        const auto fraction = [](double w) { return w - std::floor(w); };
        double sum = 0;
        for (unsigned i = 0; i < mixture.samples(); ++i) {
            Sampler<RandomSequence> sampler(numbers, i + 1);
            const double a = sampler.next<double>(), b = sampler.next<double>();
            const Mixture::Choice choice = mixture.choose(i, shift, a, b);
            // The plastic number's recurrence spreads the points over the pixel as it does the cells over their list.
            const Vec3<double> from =
                floor_point(area, fraction(x + i * 0.75487766624669276), fraction(y + i * 0.56984029099805327));
            const Seen seen = paths_(from, direction_above(choice.u, choice.v), sampler);
            sum += seen.radiance / choice.density;
            if (seen.radiance > 0 && !choice.expected)
                surprises.push_back(choice.cell);
        }
        return pi<double> * sum;
    }

    /// Source: Welford 1962, "Note on a method for calculating corrected sums of squares and products".
    void add(std::size_t pixel, double estimate) {
        const double n = double(passes_), before = estimate - result_.mean[pixel];
        result_.mean[pixel] += before / n;
        deviation2_[pixel] += before * (estimate - result_.mean[pixel]);
        if (passes_ >= 2)
            result_.standard_error[pixel] = std::sqrt(deviation2_[pixel] / (n * (n - 1)));
    }

    const BuiltinCase<double, double>& builtin_;
    const PathTraceOptions& options_;
    const AnyExecutor& executor_;
    FilmLayout layout_;
    SpecularPaths paths_;
    Guidance guidance_;
    std::vector<Cells> surprises_; ///< by block: the cells in which the last pass saw light unexpectedly
    std::uint64_t passes_ = 0;
    std::vector<double> deviation2_; ///< by pixel: sum of the squared deviations of the passes from their mean
    PathTracedReference result_;
};

} // namespace

PathTracedReference path_trace_reference(const BuiltinCase<double, double>& builtin, std::size_t width,
                                         std::size_t height, const PathTraceOptions& options,
                                         const AnyExecutor& executor, const PathTraceProgress& progress) {
    check(builtin, width, height, options);
    return PathTracer(builtin, width, height, options, executor).render(progress);
}

} // namespace nephroid::examples
