// The benchmarks as subcommands of `isochron bench`, and what they share.
#pragma once

#include <CLI/App.hpp>

#include <filesystem>
#include <string>

namespace isochron::app::bench {

void add_bench_artefacts(CLI::App& bench_command);
void add_bench_render(CLI::App& bench_command);

/// The file appears complete or not at all. @throws index::Error
void write_text(const std::filesystem::path& path, const std::string& text);

} // namespace isochron::app::bench
