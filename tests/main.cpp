// SPDX-License-Identifier: MIT
// The test program: doctest, and three things it does not say by itself. A test name that its filter cannot match is
// refused when the tests are listed, a run in which no test matched fails, and a skipped test is told from a passed one.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstring>
#include <set>

#include "tests/tier.h"

namespace {

constexpr int kSkipped = 77;   // SKIP_RETURN_CODE in tests/CMakeLists.txt

bool listing = false, names_are_good = true;
unsigned matched = 0;

// ctest runs each test case by its name, `--test-case=NAME`, through CMake lists and doctest's wildcards: names must
// be unique and free of the characters that either gives a meaning.
struct Watch : doctest::IReporter {
  explicit Watch(const doctest::ContextOptions&) {}

  void report_query(const doctest::QueryData& query) override {
    listing = true;
    std::set<std::string> seen;
    for (unsigned i = 0; i < query.num_data; ++i) {
      const doctest::TestCaseData& test = *query.data[i];
      const bool unique = seen.insert(test.m_name).second;
      if (unique && !std::strpbrk(test.m_name, ";*?\\\"$")) continue;
      std::cerr << test.m_file.c_str() << ':' << test.m_line << ": test name \"" << test.m_name << "\" "
                << (unique ? "contains one of ; * ? \\ \" $" : "is taken") << '\n';
      names_are_good = false;
    }
  }
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats& stats) override { matched = stats.numTestCasesPassingFilters; }
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

REGISTER_LISTENER("watch", 1, Watch);

}  // namespace

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  const int failed = context.run();
  if (listing) return names_are_good ? failed : 1;
  if (failed || context.shouldExit()) return failed;
  if (matched == 0) {
    std::cerr << "no test case matched\n";
    return 1;
  }
  return matched == 1 && sidelight::test::test_was_skipped ? kSkipped : 0;
}
