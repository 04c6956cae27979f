// Measures the rendering of one series in one GL context.
#pragma once

#include "index/file/index_file.h"
#include "render/drawing/cell_pass.h"
#include "stereo/context/gl_context.h"
#include "tests/bench/rows/render_rows.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::bench {

struct NamedFootprint {
    std::string_view name; ///< as in the rows
    render::Footprint footprint;
};
/// The choices of `--footprints`.
const std::vector<NamedFootprint>& all_footprints();

/// A picture: `512`, `1024`, or for both eyes `2x1024`.
struct Picture {
    int size = 0; ///< both sides of each eye's picture, pixels
    int eyes = 1;
};

struct RenderOptions {
    std::string data; ///< name of the series in the rows
    double isovalue = 0;
    stereo::ContextKind context = stereo::ContextKind::egl;
    unsigned threads = 1; ///< processors that may be used
    std::vector<NamedFootprint> footprints = all_footprints();
    std::vector<Picture> pictures{{512, 1}, {1024, 1}, {1024, 2}};
    unsigned rounds = 3; ///< through all steps
    /// [ms] Frames in motion go on for so long after these rounds, up to 500 of them.
    double motion_ms = 3e3;
    bool vtk = true; ///< measure VTK, if it can draw in the context (not OSMesa)
};

/// Makes a context and measures every picture and footprint in it. Whole frames, VTK's frames,
/// bare quads and static draws take turns at every step.
std::vector<RenderRow> measure_rendering(const std::shared_ptr<const index::IndexFile>& file,
                                         const RenderOptions& options,
                                         const index::Progress& progress);

/// The percentile of some numbers. @param numbers not empty
double percentile(std::vector<double> numbers, double percent);

} // namespace isochron::bench
