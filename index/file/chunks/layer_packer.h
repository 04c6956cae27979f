// Packs the chunks of a step for the file, layer by layer.
#pragma once

#include "index/file/chunks/chunk_codec.h"
#include "index/file/chunks/chunk_grid.h"
#include "index/file/chunks/chunk_table.h"
#include "index/file/sections/file_layout.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace isochron::index {

/// A hash of 128 bits: equal digests mean equal values.
struct ChunkDigest {
    std::uint64_t low = 0, high = 0;
    bool operator==(const ChunkDigest&) const = default;
};

/// How the chunks of a step follow from the step before: by layer and place.
struct ChunkHistory {
    /// Hashes of the values of the last step; none before the first.
    std::vector<ChunkDigest> digests;
    std::vector<std::uint32_t> since; ///< the first step from which on they have had these values
};

/// Packs steps layer by layer, each layer with all threads. Keeps the tables of a step and what must
/// be known to find the chunks of the next step that stay.
class LayerPacker {
  public:
    /// @param wide_rows see ChunkPacker
    LayerPacker(const Grid& grid, ValueType type, Codec codec, unsigned threads,
                bool wide_rows = true);

    /// Receives the bytes in order.
    using Append = std::function<void(std::span<const std::byte>)>;

    /// The contents of a layer of chunks.
    struct Layer {
        std::span<const std::byte> stored;    ///< [z][y][x]
        bool carries = true;                  ///< the values; else the file refers to sources
        std::span<const std::uint8_t> bricks; ///< layer after layer, each as from `build_bricks`
        std::uint32_t brick_layers = 0;
        bool with_bricks = true; ///< the index has bricks
    };

    /// Files of version 3 do not say which chunks stay. Call it before the first step.
    void write_without_since() { with_since_ = false; }
    /// Sets the number of the next step.
    void begin_at(std::uint32_t step) { step_ = step; }
    /// Takes the values of the next layer as those of the step before the first, without packing.
    void look(std::span<const std::byte> stored);
    ChunkHistory& history() { return history_; }
    const ChunkHistory& history() const { return history_; }
    /// Number of chunks so far that were as in the step before.
    std::uint64_t stayed() const { return stayed_; }

    /// Packs the next layer of the step.
    void pack(const Layer& layer, const Append& append);

    /// Appends the tables of the step once all its layers have been packed; then the next begins.
    /// @return sizes of the step and offset of its tables; `offset` is left 0
    StepEntry finish(const Append& append);

  private:
    /// What a thread packs with.
    struct Packer {
        ChunkPacker chunks;
        std::vector<std::byte> values;   ///< values of some chunks, one after the other
        std::vector<std::size_t> begins; ///< where each begins in `values`, and the end
        std::vector<std::array<std::uint32_t, 3>> order; ///< y, x and place of each, ascending

        std::span<const std::byte> value_of(std::size_t chunk) const {
            return std::span(values).subspan(begins[chunk], begins[chunk + 1] - begins[chunk]);
        }
    };
    template <class F>
    void for_pieces(F&& f);
    void end_layer();
    bool stays(std::uint32_t place, std::span<const std::byte> values);
    void take_values(std::span<const std::byte> stored, std::uint32_t first, std::uint32_t end,
                     Packer& to) const;
    void pack_chunk(const Layer& layer, std::uint32_t place, std::span<const std::byte> values,
                    ChunkPacker& packer, std::vector<std::byte>& out, ChunkEntry& entry);
    void pack_piece(const Layer& layer, std::uint32_t first, std::uint32_t end, Packer& packer,
                    std::vector<std::byte>& out);

    Grid grid_;
    ValueType type_;
    ChunkGrid chunks_;
    std::uint32_t together_;                     ///< chunks that a thread takes out of a layer
    std::vector<Packer> packers_;                ///< by thread
    std::vector<std::vector<std::byte>> pieces_; ///< the records of a layer
    std::vector<ChunkEntry> entries_;            ///< entries of a layer
    std::vector<std::byte> tables_;              ///< tables of the layers so far
    ChunkHistory history_;
    bool with_since_ = true, first_ = true; ///< the second: no step before is known
    std::uint32_t step_ = 0;
    std::uint64_t stayed_ = 0;
    std::uint32_t packed_ = 0; ///< layers so far
    std::uint64_t end_ = 0;    ///< where their records end
};

} // namespace isochron::index
