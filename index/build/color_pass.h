// The pass of a build that reads and packs the array to color by.
#pragma once

#include "index/build/volume_pass.h"
#include "index/file/index_contents.h"
#include "index/progress.h"
#include "index/system/team.h"

namespace isochron::index {

/// @throws Error naming the array when its grid or steps differ from the volume's
void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume);

/// The results of the pass, the same for every member of the team.
struct ColorFindings {
    ColorArray array; ///< `chosen_*` are left empty
    std::vector<StepEntry> steps;
    std::vector<std::uint64_t> checksums; ///< of the stored values of every step
};

/// Reads each member's share of the steps from `first` on, and packs their values if
/// `target.contents` asks for values.
/// @param held results for the steps before `first`; null if there are none
ColorFindings read_colors(VolumeSeries& series, std::size_t first, const ColorArray* held,
                          const PassTarget& target, Team& team, const Progress& progress);

} // namespace isochron::index
