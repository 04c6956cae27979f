// The values of an array in VTK XML, in each encoding: text, base64 or raw bytes, in blocks of zlib, LZ4 or LZMA.
// After "VTK File Formats" (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html).
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace isochron::index {

enum class BlockPacking : std::uint8_t { none, zlib, lz4, lzma };

/// How a file stores the bytes of all its arrays.
struct VtiEncoding {
    bool big_endian = false;
    bool wide_header = false; ///< counts are UInt64, else UInt32
    BlockPacking packing = BlockPacking::none;
};

/// Where an array's values stand.
struct VtiPlace {
    std::string_view stored; ///< what begins with them; may go on after their end
    enum class As : std::uint8_t { text, base64, raw } as = As::text;
};

/// The best ratio of a packing: so many bytes become one.
std::uint64_t best_ratio(BlockPacking packing);

/// Fills `out` with an array's values from the first on, in native byte order.
/// @throws Error naming `where`, the file and its array: fewer values, or no values
void read_vti_values(const VtiPlace& place, const VtiEncoding& encoding, StoredType type,
                     std::span<std::byte> out, const std::string& where);

/// The bytes of an array that stand in the file as they are in memory, `bytes` of them.
/// @return empty where they have another encoding @throws Error naming `where`: fewer bytes
std::span<const std::byte> plain_vti_values(const VtiPlace& place, const VtiEncoding& encoding,
                                            StoredType type, std::uint64_t bytes,
                                            const std::string& where);

} // namespace isochron::index
