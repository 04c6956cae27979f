// Packs the values of one chunk into bytes of the file, and unpacks them.
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

/// How values are packed. `fitting`: in packed rows; of types of several bytes, in files of earlier
/// versions, with Zstandard. `none` stores values as they are; so does every codec if a chunk would
/// hardly shrink.
enum class Codec : std::uint8_t { fitting, none, lz4, zstd };
constexpr std::array<std::string_view, 4> kCodecNames{"fitting", "none", "lz4", "zstd"};
std::optional<Codec> codec_from_name(std::string_view name);

/// Packs chunks. The bytes depend on the values and the codec only. One for each thread.
///
/// A packed chunk begins with a byte. Its low two bits are the form: 0 one value for all, 1 values
/// as they are, 2 LZ4, 3 Zstandard. Bits 2, 3 and 4: bit patterns are differences along x, y and z
/// (of unsigned numbers of the type's size, modulo 2^bits). Bit 5: the first bytes of all values
/// come first, then all second bytes, and so on. Bit 6, with form 1 only: the differences are in
/// packed rows (packed_rows.h). Of types of several bytes a byte comes before these rows: the values
/// were shifted right by so many bits, all zero, and the differences d are folded: 2 d, or -2 d - 1
/// where d is negative.
class ChunkPacker {
  public:
    /// @param wide_rows `fitting` packs types of several bytes in packed rows
    explicit ChunkPacker(Codec codec, bool wide_rows = true);
    ~ChunkPacker();
    ChunkPacker(ChunkPacker&&) noexcept;

    /// Whether one value fills a chunk.
    static bool all_equal(ValueType type, std::span<const std::byte> values);

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
/// @return false if the bytes are not a packed chunk of this size
bool unpack_chunk(ValueType type, const std::array<std::uint32_t, 3>& size,
                  std::span<const std::byte> packed, std::span<std::byte> out);

} // namespace isochron::index
