// SPDX-License-Identifier: MIT
/// @file  Tables of text: for a terminal, as Markdown, as HTML.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace nephroid::examples {

/// The cells of one row.
using TableRow = std::vector<std::string>;

/// Cells of text, row by row, under a header.
struct Table {
    std::string name;    ///< to choose it by: "equal-time"
    std::string title;   ///< a few words
    std::string caption; ///< a sentence without its full stop
    TableRow header;
    std::vector<TableRow> rows;
};

enum class TableFormat { text, markdown };

/// Prints title and caption, and below them the table: in columns as wide as their widest cell, the first to the left
/// and the others to the right, or as Markdown.
void print(std::ostream& out, const Table& table, TableFormat format);

/// One row of Markdown, for tables that grow while their figures are measured.
/// @param widths  of the columns, in letters; none where they need not line up
[[nodiscard]] std::string markdown_row(const TableRow& row, const std::vector<std::size_t>& widths = {});

/// The table as an HTML <table> under a heading.
[[nodiscard]] std::string html_of(const Table& table);

/// Text with what HTML would read as markup replaced.
[[nodiscard]] std::string escaped_for_html(const std::string& text);

} // namespace nephroid::examples
