// The results of `isochron-bench render --agreement-only`, as JSON and as a table.
#pragma once

#include "tests/bench/rows/header.h"

#include <cstdint>
#include <string>
#include <vector>

namespace isochron::bench {

/// One footprint of one cell set, compared with the exact surface. A pixel counts as lit if it
/// blocks at least half of the light behind it.
struct AgreementRow {
    std::string data, footprint, shape; ///< series; quad, gaussian; plane, voxel
    std::uint32_t step = 0;
    double isovalue = 0;
    double pixels_per_voxel = 0; ///< in the volume's middle
    double cells = 0;
    double exact_percent = 0;  ///< pixels of the picture that the exact surface lights
    double extra_percent = 0;  ///< lit only by the footprint, relative to the exact surface's
    double missed_percent = 0; ///< lit only by the exact surface, relative to all of its pixels
    /// Area between the two silhouettes divided by the length of the exact one [voxels].
    double offset = 0;
    /// Over pixels that both light: mean difference of luminance (Rec. 709, linear light), in
    /// percent of the exact surface's mean there.
    double luminance_percent = 0;
    /// Over the same pixels: mean difference of display values (sRGB), in percent of white.
    double display_percent = 0;
    /// Processor time of all threads: the fastest of several draws, in turn with the other shape.
    double draw_ms = 0;
};

struct AgreementResults {
    Header header;
    std::vector<AgreementRow> rows;
};

std::string to_json_text(const AgreementResults& results);

/// Columns for the terminal.
std::string table_of(const std::vector<AgreementRow>& rows);

} // namespace isochron::bench
