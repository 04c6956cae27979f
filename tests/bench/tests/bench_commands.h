// The benchmarks as a user runs them, in a folder of the test's own.
#pragma once

#include "tests/support/child_process.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace isochron::app {

class BenchCommands : public testing::Test {
  protected:
    using Arguments = std::vector<std::string>;

    ChildResult bench(const Arguments& arguments, const ChildOptions& how = {}) {
        return run("isochron-bench", arguments, how);
    }
    ChildResult isochron(const Arguments& arguments) { return run("isochron", arguments, {}); }

    TestFolder folder;

  private:
    ChildResult run(const char* program, const Arguments& arguments, const ChildOptions& how) {
        return run_child(test_support::binary_root() + "/" + program, arguments, folder.path(),
                         how);
    }
};

} // namespace isochron::app
