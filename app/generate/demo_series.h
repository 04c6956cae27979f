// Writes the demo data as files.
#pragma once

#include "app/generate/demo_fields.h"

#include <filesystem>
#include <vector>

namespace isochron::app {

/// Writes the series as `dir/NAME.pvd` (NAME is its kName), one .vti per step, and `dir/NAME.json`,
/// which says how it was made. The same request gives the same bytes.
/// @param force replaces another series of that name
/// @return false when the folder held exactly this series already; then nothing is written
/// @throws index::Error when the folder holds another series of that name, or cannot be written
bool generate(const SphereSeries& series, const std::filesystem::path& dir,
              const index::Progress& progress, bool force = false);
bool generate(const VorticitySeries& series, const std::filesystem::path& dir,
              const index::Progress& progress, bool force = false);
bool generate(const FourierSeries& series, const std::filesystem::path& dir,
              const index::Progress& progress, bool force = false);

/// The files that `generate` would write and that are of another origin: nothing says that they are
/// of a series. If there is a whole series of that name, `generate` itself tells which.
std::vector<std::filesystem::path> files_in_the_way(const SphereSeries& series,
                                                    const std::filesystem::path& dir);
std::vector<std::filesystem::path> files_in_the_way(const VorticitySeries& series,
                                                    const std::filesystem::path& dir);
std::vector<std::filesystem::path> files_in_the_way(const FourierSeries& series,
                                                    const std::filesystem::path& dir);

} // namespace isochron::app
