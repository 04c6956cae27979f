// The subcommands: each adds itself to the command line and runs in its callback.
#pragma once

#include <CLI/App.hpp>

namespace isochron::app {

/// Thrown by a callback for wrong usage that the parser cannot see: exit status 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Thrown by a process of a job whose first process reports what went wrong: says nothing, and
/// leaves the exit status to that one.
class ReportedElsewhere {};

void add_generate(CLI::App& program);
void add_build(CLI::App& program);
void add_query(CLI::App& program);
void add_change(CLI::App& program);
void add_info(CLI::App& program);
void add_verify(CLI::App& program);
void add_explore(CLI::App& program);
void add_replay(CLI::App& program);
void add_config(CLI::App& program);
void add_bench(CLI::App& program);

} // namespace isochron::app
