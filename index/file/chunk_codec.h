// The values of one chunk as bytes of the file, and back.
#pragma once

#include "index/volume/value_type.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace isochron::index {

/// How values are packed. `fitting` takes for each chunk what the data suggest.
enum class Codec : std::uint8_t { fitting, none, lz4, zstd };
constexpr std::array<std::string_view, 4> kCodecNames{"fitting", "none", "lz4", "zstd"};
std::optional<Codec> codec_from_name(std::string_view name);

/// Packs chunks. What it writes depends on the values and the codec alone. One for each thread.
///
/// A packed chunk begins with a byte: its low two bits say 0 one value for all, 1 values as they
/// are, 2 LZ4, 3 Zstandard; bits 2, 3 and 4 that bit patterns are differences along x, y and z (of
/// unsigned numbers of the type's size, modulo 2^bits); bit 5 that the first bytes of all values
/// come first, then their second bytes, and so on; bit 6, with 1, that they are in packed rows
/// (packed_rows.h), of types of one byte.
class ChunkPacker {
  public:
    explicit ChunkPacker(Codec codec);
    ~ChunkPacker();
    ChunkPacker(ChunkPacker&&) noexcept;

    /// Appends the packed chunk.
    /// @param values [z][y][x], x fastest, `size` of them along x, y and z
    void pack(ValueType type, const std::array<std::uint32_t, 3>& size,
              std::span<const std::byte> values, std::vector<std::byte>& out);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The inverse.
/// @param out as long as the chunk's values
/// @return false where the bytes are no packed chunk of this size
bool unpack_chunk(ValueType type, const std::array<std::uint32_t, 3>& size,
                  std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace isochron::index
