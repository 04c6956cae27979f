// Runs a program as a child process in a given folder, for tests of the command line.
#pragma once

#include "tests/support/test_folder.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {

using test_support::TestFolder;

struct ChildOptions {
    std::string out{};                  ///< file for its stdout, which is then not in the result
    std::uint64_t largest_file = 0;     ///< [byte] limit of files, as on a full disk; 0: no limit
    std::string interrupt_after{};      ///< send SIGINT when stderr contains this text
    std::chrono::seconds dies_after{0}; ///< until an alarm kills it, whatever it does; 0: never
    std::vector<int> closed{};          ///< standard streams that it begins without
    std::vector<std::string> environment{}; ///< NAME=VALUE, beside what this process has
};

struct ChildResult {
    int status = -1; ///< exit status; 1000 + signal if a signal killed it
    std::string out, err;
};

/// Runs the program and waits for its end. @throws std::runtime_error when it cannot be started
ChildResult run_child(const std::string& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder, const ChildOptions& options = {});

/// Arguments of `env` that start a job of MPI. @param command of each process
std::vector<std::string> of_processes(std::size_t count, const std::vector<std::string>& command);

} // namespace isochron::app
