// Packs the array to color by, while a build reads the steps.
#pragma once

#include "index/file/sections/index_contents.h"
#include "index/indexing/chunk_history.h"
#include "index/indexing/step_writer.h"
#include "index/indexing/value_stats.h"
#include "index/system/running_checksum.h"
#include "index/system/team.h"
#include "index/volume/volume_series.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace isochron::index {

/// @throws Error naming the array when its grid or steps differ from the volume's
void expect_colors_of(const SeriesInfo& colors, const SeriesInfo& volume);

/// The results of the pass, the same for every member of the team.
struct ColorFindings {
    ColorArray array; ///< `chosen_*` are left empty
    std::vector<StepEntry> steps;
    std::vector<std::uint64_t> checksums; ///< checksums of the stored values of every step
};

/// Takes a member's share of the new steps, and packs their values if its contents have values.
class ColorPass {
  public:
    /// @param first the first new step @param held results for the steps before it; null if there
    ///        are none @param series outlives this
    ColorPass(VolumeSeries& series, std::size_t first, const ColorArray* held,
              const ChunkContents& contents, const WriterMeans& means, const Team& team);

    VolumeSeries& series() { return series_; }
    StepWriter& writer() { return writer_; }
    /// History of the held chunks: see StepWriter::since.
    std::span<const std::uint32_t> held_since() const { return held_since_; }
    void hold_since(std::vector<std::uint32_t> since) { held_since_ = std::move(since); }
    void settle(const MemberSteps& steps, PartWriter& parts, Team& team) {
        settle_since(writer_, steps_, steps, parts, team);
    }

    /// Takes the next layer. @param parts where the whole pass, this one included, writes its parts
    void take(const LayerView& layer, PartWriter& parts);

    /// @param begin where this member's parts lie in the file
    ColorFindings agreed(std::uint64_t begin, Team& team);

  private:
    VolumeSeries& series_;
    StepWriter writer_;
    ValueRange range_;
    RunningChecksum checksum_;
    std::vector<StepEntry> steps_;
    std::vector<std::uint64_t> checksums_;
    std::vector<std::uint32_t> held_since_;
};

} // namespace isochron::index
