// SPDX-License-Identifier: MIT
/// @file  Runs the tests; fails where doctest alone would pass: at a filter that matches nothing, and when asked to
///        list tests of which one could not be run by its name.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "support/is_sanitized.hpp"

#include <cstdlib>
#include <iostream>
#include <set>
#include <string>

namespace {

bool anything_wrong = false, nothing_run = false;

void complain(const std::string& complaint) {
    std::cerr << "tests/main.cpp: " << complaint << '\n';
    anything_wrong = true;
}

/// Listens to a run of doctest beside its reporter.
class Watchman : public doctest::IReporter {
public:
    explicit Watchman(const doctest::ContextOptions&) {}

    void report_query(const doctest::QueryData& query) override {
        std::set<std::string> names;
        for (unsigned i = 0; i < query.num_data; ++i) {
            const std::string name = query.data[i]->m_name;
            // CMake splits at `;` and pairs brackets; doctest splits at `,` and takes `*` and `?` as wildcards.
            if (name.find_first_of(";[]\\") != std::string::npos)
                complain("a test's name must do without ; [ ] and \\: " + name);
            if (!names.insert(name).second)
                complain("two tests have the same name: " + name);
        }
    }

    void test_run_end(const doctest::TestRunStats& run) override {
        if (run.numTestCasesPassingFilters == 0) {
            std::cerr << "tests/main.cpp: no test matches\n";
            nothing_run = true;
        }
    }

    void test_run_start() override {}
    void test_case_start(const doctest::TestCaseData&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("watchman", 1, Watchman);

} // namespace

int main(int argc, char** argv) {
    const int result = doctest::Context(argc, argv).run();
    if (result == EXIT_SUCCESS && nothing_run) // with sanitizers some files leave all of theirs out: Meson's "skipped"
        return nephroid::tests::is_sanitized ? 77 : EXIT_FAILURE;
    return result == EXIT_SUCCESS && anything_wrong ? EXIT_FAILURE : result;
}
