// SPDX-License-Identifier: MIT
#include "common/table.hpp"

#include <algorithm>
#include <ostream>
#include <sstream>

namespace nephroid::examples {

namespace {

/// Letters of UTF-8, each as wide as another.
[[nodiscard]] std::size_t width_of(const std::string& cell) {
    return std::size_t(std::ranges::count_if(cell, [](char c) { return (c & 0xC0) != 0x80; }));
}

[[nodiscard]] std::vector<std::size_t> widths_of(const Table& table) {
    std::vector<std::size_t> widths(table.header.size());
    const auto widen = [&](const TableRow& row) {
        for (std::size_t column = 0; column < row.size() && column < widths.size(); ++column)
            widths[column] = (std::max)(widths[column], width_of(row[column]));
    };
    widen(table.header);
    for (const TableRow& row : table.rows)
        widen(row);
    return widths;
}

[[nodiscard]] std::string space_for(const std::string& cell, std::size_t width) {
    return std::string(width - (std::min)(width, width_of(cell)), ' ');
}

[[nodiscard]] std::string text_row(const TableRow& row, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
        const std::string space = space_for(row[column], widths[column]);
        line += column == 0 ? "  " + row[column] + space : "  " + space + row[column];
    }
    return line + "\n";
}

/// Words in lines of at most so many letters.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t most) {
    std::istringstream words(text);
    std::string lines;
    std::size_t width = 0;
    for (std::string word; words >> word;) {
        const std::size_t needed = width_of(word);
        if (!lines.empty())
            lines += width + 1 + needed > most ? '\n' : ' ';
        width = lines.empty() || lines.back() == '\n' ? needed : width + 1 + needed;
        lines += word;
    }
    return lines;
}

} // namespace

std::string markdown_row(const TableRow& row, const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
        line += "| " + row[column] + (column < widths.size() ? space_for(row[column], widths[column]) : "") + " ";
    return line + "|\n";
}

void print(std::ostream& out, const Table& table, TableFormat format) {
    const std::string words = table.title + ". " + table.caption + ".";
    out << '\n' << wrapped(words, 120) << '\n';
    if (format == TableFormat::markdown) {
        out << '\n' << markdown_row(table.header) << markdown_row(TableRow(table.header.size(), "---"));
        for (const TableRow& row : table.rows)
            out << markdown_row(row);
        return;
    }
    const std::vector<std::size_t> widths = widths_of(table);
    out << text_row(table.header, widths);
    for (const TableRow& row : table.rows)
        out << text_row(row, widths);
}

std::string escaped_for_html(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return result;
}

std::string html_of(const Table& table) {
    std::string html = std::string("<h3>") + escaped_for_html(table.title) + "</h3>\n<p class=\"note\">" +
                       escaped_for_html(table.caption) + ".</p>\n<div class=\"wide\"><table>\n<thead><tr>";
    for (const std::string& cell : table.header)
        html += "<th>" + escaped_for_html(cell) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (const TableRow& row : table.rows) {
        html += "<tr>";
        for (const std::string& cell : row)
            html += "<td>" + escaped_for_html(cell) + "</td>";
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

} // namespace nephroid::examples
