// SPDX-License-Identifier: MIT
// The tables of all programs: columns that line up, Markdown, HTML.
#include "common/table.hpp"

#include <doctest/doctest.h>

#include <sstream>

using namespace nephroid::examples;

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

TEST_CASE("table: HTML reads nothing in a cell as markup") {
    CHECK(html_of(table).find("<td>a &lt; b</td>") != std::string::npos);
    CHECK(escaped_for_html("\"&>") == "&quot;&amp;&gt;");
}
