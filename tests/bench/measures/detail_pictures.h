// How long pictures of levels of detail take, and how far they are from pictures of all cells.
#pragma once

#include "index/file/index_file.h"
#include "render/gl/gl.h"

#include <cstdint>
#include <memory>

namespace isochron::bench {

struct DetailOptions {
    std::uint32_t step = 0;
    double isovalue = 0;
    int picture = 480;      ///< both sides of each eye's picture, pixels
    double budget_ms = 100; ///< for a moving picture
};

/// A moving picture, as a session chooses it once it knows what cells cost.
struct MovingDetail {
    std::uint64_t all_cells = 0, cells = 0; ///< of the volume; drawn
    unsigned finest = 0, coarsest = 0;      ///< levels of detail
    double draw_ms = 0;                     ///< both eyes, median
    double extract_ms = 0;                  ///< on the worker
    /// Pixels lit wrongly, relative to those that all cells light in a picture with finer pixels.
    double extra_percent = 0, missed_percent = 0;
};
MovingDetail measure_moving_detail(const render::Gl& gl,
                                   const std::shared_ptr<const index::IndexFile>& file,
                                   const DetailOptions& options);

/// Share of the pixels of a picture at rest that differ by more than 8 of 255 from the picture of
/// all cells [percent].
double measure_settled_detail(const render::Gl& gl,
                              const std::shared_ptr<const index::IndexFile>& file,
                              const DetailOptions& options);

} // namespace isochron::bench
