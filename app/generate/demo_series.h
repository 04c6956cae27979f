// Writes the demo data as files.
#pragma once

#include "app/generate/demo_fields.h"

#include <filesystem>

namespace isochron::app {

/// Writes the series as `dir/NAME.pvd` (NAME is its kName), one .vti per step, and `dir/NAME.json`,
/// which says how it was made. The same request gives the same bytes.
/// @param force replaces another series of that name
/// @return false when the folder held exactly this series already; then nothing is written
/// @throws index::Error when the folder holds another series of that name, or files of other origin
/// where this series has its own, unless `force` is set; or when it cannot be written
bool generate(const SphereSeries& series, const std::filesystem::path& dir,
              const index::Progress& progress, bool force = false);
bool generate(const VorticitySeries& series, const std::filesystem::path& dir,
              const index::Progress& progress, bool force = false);
bool generate(const FourierSeries& series, const std::filesystem::path& dir,
              const index::Progress& progress, bool force = false);

} // namespace isochron::app
