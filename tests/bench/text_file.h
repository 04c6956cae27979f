// The files that the benchmarks write.
#pragma once

#include <filesystem>
#include <string>

namespace isochron::bench {

/// The file appears complete or not at all. @throws index::Error
void write_text(const std::filesystem::path& path, const std::string& text);

} // namespace isochron::bench
