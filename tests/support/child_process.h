// Runs a program as a child process in a given folder, for tests of the command line.
#pragma once

#include "tests/support/test_folder.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

using test_support::TestFolder;

struct ChildOptions {
    std::string out{};              ///< file for its stdout instead of the result
    std::uint64_t largest_file = 0; ///< [bytes] no file can grow beyond, as on a full disk; 0: any
    std::string interrupt_after{};  ///< SIGINT once this stands on its stderr
    std::uint64_t dies_after = 0;   ///< [us] after which an alarm kills it wherever it is; 0: never
    std::vector<std::string> environment{}; ///< NAME=VALUE, beside what this process has
};

struct ChildResult {
    int status = -1; ///< exit status; 1000 + signal if a signal killed it
    std::string out, err;
};

/// Runs the program and waits for its end. @throws std::runtime_error when it cannot be started
ChildResult run_child(const std::string& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder, const ChildOptions& options = {});

} // namespace isochron::app
