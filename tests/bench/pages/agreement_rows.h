// What `isochron-bench render --agreement-only` says, as JSON and as a table.
#pragma once

#include "tests/bench/pages/header.h"

#include <cstdint>
#include <string>
#include <vector>

namespace isochron::bench {

/// One footprint of one cell set beside the exact surface. A pixel is lit where at least half of
/// the light behind it is stopped.
struct AgreementRow {
    std::string data, footprint, shape; ///< series; quad, gaussian; plane, voxel
    std::uint32_t step = 0;
    double isovalue = 0;
    double pixels_per_voxel = 0; ///< in the volume's middle
    double cells = 0;
    double exact_percent = 0;  ///< pixels of the picture that the exact surface lights
    double extra_percent = 0;  ///< lit by the footprint alone, of those of the exact surface
    double missed_percent = 0; ///< lit by the exact surface alone, likewise
    /// Area between the two silhouettes over the length of the exact one [voxels].
    double offset = 0;
    /// Where both light: mean difference of luminance (Rec. 709, linear light), in percent of the
    /// exact surface's mean there,
    double luminance_percent = 0;
    /// and of display values (sRGB), in percent of white.
    double display_percent = 0;
    /// Processor time of all threads, the fastest of several draws, in turn with the other shape's.
    double draw_ms = 0;
};

struct AgreementResults {
    Header header;
    std::vector<AgreementRow> rows;
};

std::string to_json_text(const AgreementResults& results);

/// @param name of the file, for errors
/// @throws index::Error when something is missing, or of another kind
AgreementResults agreement_results_from_json(const std::string& text, const std::string& name);

/// Markdown, the part of the page of results that is about footprints beside the exact surface.
/// @param source the file that the results come from, as the page names it
std::string agreement_section(const AgreementResults& results, const std::string& source);

/// Columns for the terminal.
std::string table_of(const std::vector<AgreementRow>& rows);

} // namespace isochron::bench
