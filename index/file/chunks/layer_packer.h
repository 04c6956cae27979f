// Packs the chunks of a step for the file, layer by layer.
#pragma once

#include "index/file/chunks/chunk_codec.h"
#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_table.h"
#include "index/file/sections/file_layout.h"

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace isochron::index {

/// Packs steps layer by layer, each layer with all threads. Keeps only the tables of a step.
class LayerPacker {
  public:
    LayerPacker(const Grid& grid, ValueType type, Codec codec, unsigned threads);

    /// Receives the bytes in order.
    using Append = std::function<void(std::span<const std::byte>)>;

    /// The contents of a layer of chunks.
    struct Layer {
        std::span<const std::byte> stored;    ///< [z][y][x]; empty when the file refers to sources
        std::span<const std::uint8_t> bricks; ///< layer after layer, each as from `build_bricks`
        std::uint32_t brick_layers = 0;
        bool with_bricks = true; ///< the index has bricks
    };

    /// Packs the next layer of the step.
    void pack(const Layer& layer, const Append& append);

    /// Appends the tables of the step once all its layers have been packed; then the next begins.
    /// @return sizes of the step and offset of its tables; `offset` is left 0
    StepEntry finish(const Append& append);

  private:
    /// What a thread packs with.
    struct Packer {
        ChunkPacker chunks;
        std::vector<std::byte> values;                   ///< of some chunks, one after the other
        std::vector<std::size_t> begins;                 ///< of each in `values`, and the end
        std::vector<std::array<std::uint32_t, 3>> order; ///< y, x and place of each, ascending
    };
    void take_values(const Layer& layer, std::uint32_t first, std::uint32_t end, Packer& to) const;
    void pack_chunk(const Layer& layer, std::uint32_t place, std::span<const std::byte> values,
                    ChunkPacker& packer, std::vector<std::byte>& out, ChunkEntry& entry) const;
    void pack_piece(const Layer& layer, std::uint32_t first, std::uint32_t end, Packer& packer,
                    std::vector<std::byte>& out);

    Grid grid_;
    ValueType type_;
    ChunkGrid chunks_;
    std::uint32_t together_;                     ///< chunks that a thread takes out of a layer
    std::vector<Packer> packers_;                ///< by thread
    std::vector<std::vector<std::byte>> pieces_; ///< the records of a layer
    std::vector<ChunkEntry> entries_;            ///< of a layer
    std::vector<std::byte> tables_;              ///< of the layers so far
    std::uint32_t packed_ = 0;                   ///< layers so far
    std::uint64_t end_ = 0;                      ///< of their records
};

} // namespace isochron::index
