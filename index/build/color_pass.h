// The pass of a build that reads the array to color by.
#pragma once

#include "index/file/index_file.h"
#include "index/progress.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

namespace isochron::index {

/// @throws Error naming the array when its grid or its steps are not the volume's
void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume);

/// Reads each member's share of the steps; writes their values where `with_values`, and the first
/// member the table of checksums (see `ColorSection`), at `offset`.
/// @return what is known of the array, the same for every member; `chosen_*` are left empty
/// @param table_checksum of the table of checksums
ColorArray read_colors(VolumeSeries& series, NewFile& file, std::uint64_t offset, bool with_values,
                       Team& team, const Progress& progress, std::uint64_t& table_checksum);

} // namespace isochron::index
