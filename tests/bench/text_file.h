// Writes the text files of the benchmarks.
#pragma once

#include <filesystem>
#include <string>

namespace isochron::bench {

/// Writes a file, which appears complete or not at all. @throws index::Error
void write_text(const std::filesystem::path& path, const std::string& text);

} // namespace isochron::bench
