// SPDX-License-Identifier: MIT
/// @file  Divides the film on the floor into pixels, blocks of pixels that learn together, and tiles of blocks.
#pragma once

#include "common/builtin_cases.hpp"

#include <algorithm>
#include <cstddef>

namespace nephroid::examples {

/// Rectangles of the film, all in the order of its pixels: row by row, that with the smallest y first.
class FilmLayout {
public:
    /// @param width,height  in pixels, 1 to 32768
    FilmLayout(const FilmRectangle& film, std::size_t width, std::size_t height)
        : film_(film), pixels_{width, height}, blocks_(pixels_, most_blocks, 1), tiles_(blocks_.count, most_tiles, 4) {}

    [[nodiscard]] std::size_t pixels() const { return pixels_.total(); }
    [[nodiscard]] std::size_t blocks() const { return blocks_.count.total(); }
    [[nodiscard]] std::size_t tiles() const { return tiles_.count.total(); }

    /// The part of the floor under a pixel, a block, a tile.
    [[nodiscard]] FilmRectangle pixel(std::size_t i) const {
        const Place at = pixels_.at(i);
        return area({at.x, at.x + 1, at.y, at.y + 1});
    }
    [[nodiscard]] FilmRectangle block(std::size_t i) const { return area(block_pixels(i)); }
    [[nodiscard]] FilmRectangle tile(std::size_t i) const {
        const Range blocks = tiles_.members(i);
        const Range first = blocks_.members(blocks_.count.index(blocks.x, blocks.y));
        const Range last = blocks_.members(blocks_.count.index(blocks.x_end - 1, blocks.y_end - 1));
        return area({first.x, last.x_end, first.y, last.y_end});
    }

    [[nodiscard]] std::size_t tile_of(std::size_t block) const { return tiles_.group_of(blocks_.count.at(block)); }

    template <class Visit>
    void for_pixels_of(std::size_t block, Visit&& visit) const {
        block_pixels(block).for_each([&](Place place) { visit(pixels_.index(place.x, place.y)); });
    }

    /// Visits the neighbours of a block, up to eight.
    template <class Visit>
    void for_neighbours_of(std::size_t block, Visit&& visit) const {
        const Place at = blocks_.count.at(block);
        const Range about{at.x - (at.x > 0), (std::min)(at.x + 2, blocks_.count.x), at.y - (at.y > 0),
                          (std::min)(at.y + 2, blocks_.count.y)};
        about.for_each([&](Place place) {
            if (const std::size_t other = blocks_.count.index(place.x, place.y); other != block)
                visit(other);
        });
    }

private:
    // These bounds make memory and the pilot's effort about the same for every film.
    static constexpr std::size_t most_blocks = 256, most_tiles = 32;

    struct Place {
        std::size_t x, y;
    };

    struct Range {
        std::size_t x, x_end, y, y_end;

        template <class Visit>
        void for_each(Visit&& visit) const {
            for (std::size_t j = y; j < y_end; ++j)
                for (std::size_t i = x; i < x_end; ++i)
                    visit(Place{i, j});
        }
    };

    struct Count {
        std::size_t x, y;
        [[nodiscard]] std::size_t total() const { return x * y; }
        [[nodiscard]] Place at(std::size_t i) const { return {i % x, i / x}; }
        [[nodiscard]] std::size_t index(std::size_t i, std::size_t j) const { return j * x + i; }
    };

    /// Squares of members, smaller ones at the upper ends.
    struct Groups {
        Groups(const Count& of, std::size_t most, std::size_t least_side) : members_(of) {
            side = (std::max)(least_side, ((std::max)(of.x, of.y) + most - 1) / most);
            count = {(of.x + side - 1) / side, (of.y + side - 1) / side};
        }
        [[nodiscard]] Range members(std::size_t group) const {
            const Place at = count.at(group);
            return {at.x * side, (std::min)((at.x + 1) * side, members_.x), at.y * side,
                    (std::min)((at.y + 1) * side, members_.y)};
        }
        [[nodiscard]] std::size_t group_of(Place member) const { return count.index(member.x / side, member.y / side); }

        std::size_t side;
        Count count;

    private:
        Count members_;
    };

    [[nodiscard]] Range block_pixels(std::size_t i) const { return blocks_.members(i); }

    [[nodiscard]] FilmRectangle area(const Range& pixels) const {
        const auto x = [this](std::size_t i) {
            return film_.x_min + (film_.x_max - film_.x_min) * (double(i) / double(pixels_.x));
        };
        const auto y = [this](std::size_t j) {
            return film_.y_min + (film_.y_max - film_.y_min) * (double(j) / double(pixels_.y));
        };
        return {x(pixels.x), x(pixels.x_end), y(pixels.y), y(pixels.y_end)};
    }

    FilmRectangle film_;
    Count pixels_;
    Groups blocks_, tiles_;
};

} // namespace nephroid::examples
