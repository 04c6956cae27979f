// Measures, in pixels, the two sources of error that section 7 of the paper names: normals that are
// kept over a time span, and false positives that are drawn.
#pragma once

#include "index/file/index_file.h"
#include "index/paper/thi_tree.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/image.h"
#include "tests/bench/rivals/span_normals.h"
#include "tests/bench/rows/rows.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::bench {

/// Difference of two pictures of the same size, over the pixels where at least one of them shows
/// something. A pixel's difference is the largest of its color channels', 0 to 255.
struct PixelDifference {
    double mean = 0, p99 = 0;
    double changed_percent = 0; ///< share of these pixels that differ by more than kVisible
    static constexpr int kVisible = 5;
};
PixelDifference difference(const render::Image& a, const render::Image& b);

/// One footprint of one series, drawn from one tree: means over the steps.
struct ArtifactRow {
    std::string data, footprint;
    std::uint32_t l = 0, max_variation = 0;
    double cells = 0;
    double angle_mean = 0, angle_p99 = 0; ///< degrees, between kept and exact normals
    double normals_mean = 0, normals_p99 = 0, normals_changed_percent = 0;
    double false_positive_percent = 0; ///< share of the active cells
    double false_mean = 0, false_p99 = 0, false_changed_percent = 0;
};

struct ArtifactResults {
    Header header;
    std::vector<ArtifactRow> rows;
};
std::string to_json_text(const ArtifactResults& results);

/// The sets of cells that are drawn for one step.
struct ArtifactSets {
    index::CellSetPtr exact;           ///< the active cells with normals of this step
    index::CellSetPtr kept_normals;    ///< the active cells with the normals that the tree stores
    index::CellSetPtr false_positives; ///< all cells that the tree finds, with normals of this step
};
ArtifactSets artifact_sets(const index::StepValues& values, const index::ThiTree& tree,
                           const index::Query& query);

/// Pictures of the three sets, from the camera of the rendering benchmark.
struct ArtifactPictures {
    render::Image exact, kept_normals, false_positives;
};

/// Draws series in the current context.
class ArtifactBench {
  public:
    /// @param size of both sides of the pictures, pixels
    ArtifactBench(const render::Gl& gl, std::shared_ptr<const index::IndexFile> file, int size);

    ArtifactPictures draw(const ArtifactSets& sets, render::Footprint footprint);
    render::Image draw(const index::CellSetPtr& set, render::Footprint footprint);

    /// @param every draw each `every`-th step
    std::vector<ArtifactRow> measure(const std::string& data, const index::ThiOptions& options,
                                     double isovalue, std::uint32_t every,
                                     const index::Progress& progress);

  private:
    const render::Gl& gl_;
    std::shared_ptr<const index::IndexFile> file_;
    int size_;
    render::CellPass pass_;
};

/// Pictures of the same height next to each other.
render::Image side_by_side(const std::vector<render::Image>& pictures);
/// The difference of two pictures, times `gain`; black where they are equal.
render::Image difference_picture(const render::Image& a, const render::Image& b, int gain);

} // namespace isochron::bench
