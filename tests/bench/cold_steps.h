// The first look at small steps of a series, beside a plain read with a scan.
#pragma once

#include "index/indexing/index_build.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace isochron::bench {

/// Measures series of 64^3 to 256 x 128 x 64 vertices, of u8 and f32.
/// @param folder on a disk @param print gets each row
/// @throws Error where the index finds other cells than the scan
void measure_cold_steps(const std::filesystem::path& folder, const index::Progress& progress,
                        const std::function<void(const std::string& row)>& print);

/// Drops a file from the page cache. @throws Error if it cannot be opened
void forget(const std::filesystem::path& path);
/// Elapsed time [s].
double seconds_of(const std::function<void()>& work);

} // namespace isochron::bench
