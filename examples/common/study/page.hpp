// SPDX-License-Identifier: MIT
/// @file  An HTML page with plots, pictures and tables in it, that needs no other file and no script.
#pragma once

#include "common/study/plot.hpp"
#include "common/table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::examples::study {

/// A picture that has been written as .png, and perhaps another below it.
struct Exhibit {
    std::string title, note;
    std::filesystem::path picture, difference; ///< no difference: an empty path
};

/// Pictures side by side.
struct Strip {
    std::string title;
    std::vector<Exhibit> exhibits;
};

class Page {
public:
    explicit Page(const std::string& title);

    void heading(const std::string& text);
    /// @param html  as it is to stand there
    void paragraph(const std::string& html);
    void note(const std::string& html);
    void table(const Table& table);
    /// A table that is seen when its summary is clicked.
    void folded_table(const std::string& summary, const Table& table);
    /// Plots in a grid; a note in their place if there are none.
    void plots(const std::vector<Plot>& plots);
    /// Whole pictures in a grid.
    void pictures(const std::vector<Exhibit>& exhibits);
    void strip(const Strip& strip);

    /// The page.
    [[nodiscard]] std::string html() const;

private:
    std::string body_;
    std::string title_;
    std::size_t plots_ = 0;
};

/// The processor, as the system names it, and the compiler: "Xeon 8481C, g++ 12.2".
[[nodiscard]] std::string machine();

} // namespace nephroid::examples::study
