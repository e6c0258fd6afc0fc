// SPDX-License-Identifier: MIT
#include "common/path_tracer/pilot.hpp"

#include "nephroid/sequence/sequence.hpp"

#include <cmath>
#include <iterator>
#include <numeric>

namespace nephroid::examples {

namespace {

constexpr unsigned coarse_level = 6;   // 4096 cells, each 1/20 across at the zenith
constexpr unsigned finest_level = 10;  // beyond this, memory
constexpr double cells_wanted = 1024;  // from which an average block sees the enlarged light; 64 see the real one
constexpr unsigned sharing_rounds = 2; // between blocks
constexpr std::array enlargements{1., 2., 4.}; // of the lights: in the fine grid, that before, and all before those

/// The lights and, for a factor above 1, larger ones with the same centres. Points inside of these still see the real
/// lights.
[[nodiscard]] Emitters<double, double> enlarged(Emitters<double, double> emitters, double factor) {
    const std::size_t count = emitters.size();
    for (std::size_t i = 0; factor > 1 && i < count; ++i) {
        emitters.push_back(emitters[i]);
        emitters.back().radius *= factor;
    }
    return emitters;
}

/// What the paths into one cell found.
struct Finding {
    std::uint32_t cell;
    double light2;     ///< mean square of the radiance
    bool met_specular; ///< by any path
    unsigned lit;      ///< paths with light
};

class Explorer {
public:
    Explorer(const BuiltinCase<double, double>& builtin, const FilmLayout& layout, const PilotOptions& options,
             const AnyExecutor& executor)
        : builtin_(builtin), layout_(layout), options_(options), executor_(executor) {
        for (const double factor : enlargements)
            emitters_.push_back(enlarged(builtin.emitters, factor));
        guidance_.coarse = DirectionGrid(coarse_level);
        guidance_.fine = DirectionGrid(finest_level); // until more is known
    }

    [[nodiscard]] Guidance explore() {
        explore_tiles();
        guidance_.fine = DirectionGrid(fine_level());
        found_.resize(layout_.blocks());
        executor_(layout_.blocks(), [this](std::size_t block) { explore_block(block); });
        for (unsigned round = 0; round < sharing_rounds; ++round)
            share_findings(round);
        guidance_.light.resize(layout_.blocks());
        executor_(layout_.blocks(), [this](std::size_t block) { guidance_.light[block] = guide_for(block); });
        return std::move(guidance_);
    }

private:
    /// The lights in the size for a grid.
    [[nodiscard]] const Emitters<double, double>& emitters_for(const DirectionGrid& grid) const {
        return emitters_[(std::min)(emitters_.size() - 1, std::size_t(guidance_.fine.level() - grid.level()))];
    }

    /// Follows paths from all over an area into each of the given cells.
    ///
    /// @param stage,index  what the random numbers are for: different pairs, different numbers
    [[nodiscard]] std::vector<Finding> look(const FilmRectangle& area, const DirectionGrid& grid, const Cells& cells,
                                            unsigned paths_per_cell, std::uint64_t stage, std::size_t index) const {
        const SpecularPaths paths(builtin_.scene, emitters_for(grid), options_.specular_events);
        const RandomSequence numbers(hash_bits(hash_bits(options_.seed, stage), index));
        std::vector<Finding> findings;
        findings.reserve(cells.size());
        std::uint64_t path = 0;
        for (const std::uint32_t cell : cells) {
            Finding finding{cell, 0, false, 0};
            for (unsigned i = 0; i < paths_per_cell; ++i) {
                Sampler<RandomSequence> sampler(numbers, path++);
                const double x = sampler.next<double>(), y = sampler.next<double>();
                const double a = sampler.next<double>(), b = sampler.next<double>();
                const auto [u, v] = grid.point_in(cell, a, b);
                const Seen seen = paths(floor_point(area, x, y), direction_above(u, v), sampler);
                finding.light2 += square(seen.radiance) / paths_per_cell;
                finding.met_specular = finding.met_specular || seen.met_specular;
                finding.lit += seen.radiance > 0;
            }
            findings.push_back(finding);
        }
        return findings;
    }

    void explore_tiles() {
        const DirectionGrid grid = guidance_.coarse;
        Cells all(grid.cells());
        std::iota(all.begin(), all.end(), 0u);
        guidance_.specular.resize(layout_.tiles());
        guidance_.halo.resize(layout_.tiles());
        lit_in_tile_.resize(layout_.tiles());
        lit_paths_.resize(layout_.tiles());
        executor_(layout_.tiles(), [&](std::size_t tile) {
            Cells specular;
            for (const Finding& f : look(layout_.tile(tile), grid, all, options_.paths_per_cell, 0, tile)) {
                if (f.met_specular)
                    specular.push_back(f.cell);
                if (f.lit > 0)
                    lit_in_tile_[tile].push_back(f.cell);
                lit_paths_[tile] += f.lit;
            }
            guidance_.specular[tile] = CellSet(grid, grown(grid, specular));
            guidance_.halo[tile] = CellSet(grid, grown(grid, lit_in_tile_[tile]));
        });
    }

    /// The level at which light fills about `cells_wanted` cells.
    [[nodiscard]] unsigned fine_level() const {
        double lit_share = 0, lit_tiles = 0;
        for (const std::size_t lit : lit_paths_) {
            lit_share += double(lit) / (double(guidance_.coarse.cells()) * options_.paths_per_cell);
            lit_tiles += lit > 0;
        }
        if (!(lit_share > 0))
            return coarse_level;
        const double level = 0.5 * std::log2(cells_wanted * lit_tiles / lit_share);
        return static_cast<unsigned>((std::clamp)(std::lround(level), long(coarse_level), long(finest_level)));
    }

    [[nodiscard]] unsigned paths_per_cell_of_block() const { return (options_.paths_per_cell + 1) / 2; }

    void explore_block(std::size_t block) {
        DirectionGrid grid = guidance_.coarse;
        Cells cells = lit_in_tile_[layout_.tile_of(block)];
        if (cells.empty())
            return;
        do {
            cells = grown(grid, cells);
            if (grid.level() < guidance_.fine.level()) {
                cells = divided(grid, cells);
                grid = DirectionGrid(grid.level() + 1);
            }
            found_[block] =
                lit(look(layout_.block(block), grid, cells, paths_per_cell_of_block(), grid.level(), block));
            cells = cells_of(found_[block]);
        } while (grid.level() < guidance_.fine.level() && !cells.empty());
    }

    /// Each block looks where its neighbours have seen light, so that small or faint light found by one block is known
    /// to the others.
    void share_findings(unsigned round) {
        std::vector<std::vector<Finding>> news(layout_.blocks());
        executor_(layout_.blocks(), [&](std::size_t block) {
            const Cells told = cells_known_about(block), known = cells_of(found_[block]);
            Cells fresh;
            std::set_difference(told.begin(), told.end(), known.begin(), known.end(), std::back_inserter(fresh));
            news[block] = lit(look(layout_.block(block), guidance_.fine, fresh, paths_per_cell_of_block(),
                                   finest_level + 1 + round, block));
        });
        executor_(layout_.blocks(), [&](std::size_t block) {
            const auto by_cell = [](const Finding& a, const Finding& b) { return a.cell < b.cell; };
            std::vector<Finding> merged;
            merged.reserve(found_[block].size() + news[block].size());
            std::merge(found_[block].begin(), found_[block].end(), news[block].begin(), news[block].end(),
                       std::back_inserter(merged), by_cell);
            found_[block] = std::move(merged);
        });
    }

    /// All cells with light as seen from this block and those about it, and the cells around. Weights grow as the root
    /// of the mean square, which makes the variance least.
    [[nodiscard]] Guide guide_for(std::size_t block) const {
        const std::vector<Finding>& found = found_[block];
        double most = 0;
        for (const Finding& f : found)
            most = (std::max)(most, f.light2);
        std::vector<Guide::WeightedCell> cells;
        auto next = found.begin();
        for (const std::uint32_t cell : grown(guidance_.fine, cells_known_about(block))) {
            std::uint32_t weight = Guide::edge_weight;
            if (next != found.end() && next->cell == cell) {
                const double share = std::sqrt(next->light2 / most);
                weight = (std::max)(weight, static_cast<std::uint32_t>(std::lround(share * Guide::full_weight)));
                ++next;
            }
            cells.push_back({cell, weight});
        }
        return Guide(cells);
    }

    [[nodiscard]] Cells cells_known_about(std::size_t block) const {
        Cells known = cells_of(found_[block]);
        layout_.for_neighbours_of(block, [&](std::size_t other) {
            for (const Finding& f : found_[other])
                known.push_back(f.cell);
        });
        sort_unique(known);
        return known;
    }

    [[nodiscard]] static std::vector<Finding> lit(std::vector<Finding> findings) {
        std::erase_if(findings, [](const Finding& f) { return f.lit == 0; });
        findings.shrink_to_fit();
        return findings;
    }

    [[nodiscard]] static Cells cells_of(const std::vector<Finding>& findings) {
        Cells cells;
        cells.reserve(findings.size());
        for (const Finding& f : findings)
            cells.push_back(f.cell);
        return cells;
    }

    const BuiltinCase<double, double>& builtin_;
    const FilmLayout& layout_;
    const PilotOptions& options_;
    const AnyExecutor& executor_;
    std::vector<Emitters<double, double>> emitters_; ///< enlarged
    Guidance guidance_;
    std::vector<Cells> lit_in_tile_;          ///< coarse cells
    std::vector<std::size_t> lit_paths_;      ///< number of them, by tile
    std::vector<std::vector<Finding>> found_; ///< by block: cells with light, sorted
};

} // namespace

Guidance explore(const BuiltinCase<double, double>& builtin, const FilmLayout& layout, const PilotOptions& options,
                 const AnyExecutor& executor) {
    return Explorer(builtin, layout, options, executor).explore();
}

} // namespace nephroid::examples
