// SPDX-License-Identifier: MIT
// The tables of all programs: columns that line up, Markdown, HTML.
#include "common/table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace nephroid::examples::table_test {

namespace {

const Table table{"few", "A title", "A caption", {"name", "value"}, {{"épée", "1"}, {"a < b", "12.5"}}};

[[nodiscard]] std::string printed(TableFormat format) {
    std::ostringstream out;
    print(out, table, format);
    return out.str();
}

} // namespace

TEST_CASE("table: text lines up by letters, not by bytes") {
    CHECK(printed(TableFormat::text) == "\nA title. A caption.\n"
                                        "  name   value\n"
                                        "  épée       1\n"
                                        "  a < b   12.5\n");
}

TEST_CASE("table: Markdown has a line under its header") {
    CHECK(printed(TableFormat::markdown) == "\nA title. A caption.\n\n"
                                            "| name | value |\n"
                                            "| --- | --- |\n"
                                            "| épée | 1 |\n"
                                            "| a < b | 12.5 |\n");
    CHECK(markdown_row({"é", "b"}, {3, 1}) == "| é   | b |\n");
}

TEST_CASE("table: long captions are wrapped") {
    Table wordy = table;
    wordy.caption.clear();
    for (int i = 0; i < 60; ++i)
        wordy.caption += "word ";
    std::ostringstream out;
    print(out, wordy, TableFormat::markdown);
    std::istringstream lines(out.str());
    std::size_t longest = 0;
    for (std::string line; std::getline(lines, line);)
        longest = (std::max)(longest, line.size());
    CHECK(longest > 110);
    CHECK(longest <= 120);
}

TEST_CASE("table: HTML reads nothing in a cell as markup") {
    CHECK(html_of(table).find("<td>a &lt; b</td>") != std::string::npos);
    CHECK(escaped_for_html("\"&>") == "&quot;&amp;&gt;");
}

} // namespace nephroid::examples::table_test
