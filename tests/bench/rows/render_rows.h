// The results of `isochron-bench render`: frame rates and stages, as JSON and as a table.
#pragma once

#include "tests/bench/rows/rows.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isochron::bench {

/// One footprint of one series in one kind of picture. A frame extracts the next step, sends, sorts
/// and draws it and waits until it is drawn; times are medians over the frames, wall-clock.
struct RenderRow {
    std::string data, footprint; ///< quad, gaussian, ...
    int size = 0;                ///< both sides of each eye's picture, pixels
    int eyes = 1;
    unsigned threads = 1; ///< processors that may be used
    std::string context;  ///< egl, osmesa
    double cells = 0;     ///< mean over the steps
    double fps = 0;       ///< whole frames per second
    /// These steps, contoured by flying edges with normals and drawn by VTK's renderer.
    std::optional<double> vtk_fps;
    /// Only drawing plain quads at the cells, with the size of the largest footprints.
    std::optional<double> bare_fps;
    /// While time plays and the isovalue is dragged, with extraction on its own thread: time of a
    /// frame divided by the median of later draws of the same cells; 99th percentile and worst.
    double p99_over_static = 0, worst_over_static = 0;
    double static_p99_over_static = 0; ///< latter draws over their own median: the machine's noise
    double extract_ms = 0, order_ms = 0, upload_ms = 0;
    /// Ids that are sent to a GPU as differences from step to step, in percent of the sets' ids.
    std::optional<double> sent_ids_percent;
    double draw_ms = 0; ///< clearing, drawing and waiting until it is done
    /// Cells drawn as quads, if the program draws points.
    std::optional<double> quads_ms;
    /// Processor time of all threads, which depends less on other work on the machine.
    double frame_cpu_ms = 0, draw_cpu_ms = 0;
    std::optional<double> quads_cpu_ms, bare_cpu_ms, vtk_cpu_ms;
};

struct RenderResults {
    Header header;
    std::vector<RenderRow> rows;
};

std::string to_json_text(const RenderResults& results);

/// @param name of the file, for errors
/// @throws index::Error when a field is missing or has the wrong type
RenderResults render_results_from_json(const std::string& text, const std::string& name);

/// Columns for the terminal.
std::string table_of(const std::vector<RenderRow>& rows);

} // namespace isochron::bench
