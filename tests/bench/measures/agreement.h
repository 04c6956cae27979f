// Compares quads and splats with the exact surface: silhouettes and light, pixel by pixel.
#pragma once

#include "index/file/index_file.h"
#include "tests/bench/rows/agreement_rows.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace isochron::bench {

struct AgreementOptions {
    std::string data; ///< name of the series in the rows
    std::uint32_t step = 0;
    std::vector<double> isovalues;
    std::vector<double> pixels_per_voxel{4.0, 12.0}; ///< in the volume's middle
};

/// Draws the exact surface, and quads and splats of both shapes, in one view of the bench's camera
/// (perspective, on black), and compares the pictures: see `AgreementRow`. Speeds are measured on
/// the same draws, in turn.
std::vector<AgreementRow> measure_agreement(const std::shared_ptr<const index::IndexFile>& file,
                                            const AgreementOptions& options);

} // namespace isochron::bench
