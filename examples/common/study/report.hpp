// SPDX-License-Identifier: MIT
/// @file  The answer of a study as it comes together: tables on the terminal, and all of it on one page in a folder.
#pragma once

#include "common/study/options.hpp"
#include "common/study/page.hpp"

#include <string>
#include <vector>

namespace nephroid::examples::study {

/// The folder is made when the report is, so that a place that cannot be written to shows before anything is measured.
class Report {
public:
    /// Throws std::runtime_error if nothing can be written to the folder.
    Report(const Presentation& presentation, const std::string& title);

    /// What is added to the page alone.
    [[nodiscard]] Page& page() { return page_; }
    /// `output`/name
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return presentation_.output / name; }
    /// A folder in the output folder, which is made.
    [[nodiscard]] std::filesystem::path folder(const std::string& name) const;

    /// Prints the table if it was asked for by name, or if none were asked for and it is a usual one.
    void print(const Table& table, bool is_usual = true) const;
    /// Prints the table and adds it to the page.
    void show(const Table& table);
    void show(const std::vector<Table>& tables);
    /// A line for the terminal, on what is missing.
    void say(const std::string& line) const;
    /// Draws the plots in `output`/where; says so if it cannot.
    [[nodiscard]] std::vector<Plot> draw(const std::vector<Drawing>& drawings,
                                         const std::string& where = "plots") const;
    /// A file of figures: `output`/name.
    void write(const std::string& name, const std::string& text) const;

    /// Writes the page, and says where all is.
    void finish();

private:
    Presentation presentation_;
    Page page_;
};

} // namespace nephroid::examples::study
