// A step and its levels of detail as they go into the file.
#pragma once

#include "index/build/part_writer.h"
#include "index/file/chunk_codec.h"
#include "index/file/step_packer.h"
#include "index/volume/volume_series.h"

#include <cstddef>
#include <span>
#include <vector>

namespace isochron::index {

/// What goes into the chunks of an array.
struct ChunkContents {
    bool bricks = true;
    bool values = true; ///< of the steps themselves; those of their levels of detail always
    Codec codec = Codec::fitting;
};

/// Writes steps of one array, each with all threads. Keeps its work space.
class StepWriter {
  public:
    StepWriter(const SeriesInfo& info, const ChunkContents& contents, unsigned threads);

    /// Writes the step, then its levels of detail, each from a multiple of 64.
    /// @param stored aligned for the type
    /// @param entries gets one for each level, offsets from the first of `parts`
    void write(std::span<const std::byte> stored, PartWriter& parts,
               std::vector<StepEntry>& entries);

  private:
    void write_level(std::size_t level, std::span<const std::byte> stored, PartWriter& parts,
                     std::vector<StepEntry>& entries);

    ValueType type_;
    ChunkContents contents_;
    unsigned threads_;
    std::vector<Grid> grids_; ///< by level
    std::vector<StepPacker> packers_;
    std::vector<std::vector<std::uint64_t>> coarse_; ///< values of the levels from the first on
    std::vector<std::uint8_t> bricks_;
};

/// Entries step by step become entries array by array.
std::vector<StepEntry> by_level(std::span<const StepEntry> by_step, std::size_t levels);

} // namespace isochron::index
