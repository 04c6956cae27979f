// The chunks of a step as they are written to the file.
#pragma once

#include "index/file/chunk_codec.h"
#include "index/file/chunk_grid.h"
#include "index/file/file_layout.h"

#include <functional>
#include <span>
#include <vector>

namespace isochron::index {

/// Packs steps, each with all threads, a few layers at a time.
class StepPacker {
  public:
    StepPacker(const Grid& grid, ValueType type, Codec codec, unsigned threads);

    /// Takes the bytes in their order.
    using Append = std::function<void(std::span<const std::byte>)>;

    /// @param stored values of the step, [z][y][x]; empty when the file refers to its sources
    /// @param bricks as from `build_bricks`; empty in an index without
    /// @return where the tables are; `offset` is left 0
    StepEntry pack(std::span<const std::byte> stored, std::span<const std::uint8_t> bricks,
                   const Append& append);

  private:
    struct Layer;
    void pack_layer(std::span<const std::byte> stored, std::span<const std::uint8_t> bricks,
                    std::uint32_t layer, ChunkPacker& packer, Layer& out) const;

    Grid grid_;
    ValueType type_;
    ChunkGrid chunks_;
    std::vector<ChunkPacker> packers_; ///< by thread
};

} // namespace isochron::index
