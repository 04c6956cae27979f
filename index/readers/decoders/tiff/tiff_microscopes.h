// What programs of microscopes say of a TIFF file's pages: ScanImage, Zeiss LSM, MetaMorph.
#pragma once

#include "index/readers/decoders/tiff/tiff_stack.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace isochron::index {

/// Reads so many bytes of a file from an offset; fewer where it ends.
using BytesAt = std::function<std::string(std::uint64_t offset, std::size_t count)>;

/// ScanImage's lines `SI.key = value` (2015 and later), `scanimage.SI4.key = value` and
/// `state.key=value`; none: other text. Where z is swept fast, the frames of a volume follow each
/// other, and those of the way back are left out; else the frames of a slice do.
std::optional<TiffStack> scanimage_stack(const std::string& text, std::size_t pages);

/// Zeiss LSM's record of a file, tag 34412, little-endian; none: it is none.
/// @param pages without thumbnails
/// @throws Error naming the file: several positions, sizes that the pages do not have
std::optional<TiffStack> lsm_stack(const std::string& record, std::size_t pages,
                                   const BytesAt& bytes_at, const std::string& file);

/// MetaMorph's stacks (.stk), told by tag 33629: planes that follow the first page without
/// directories. None: other TIFF. Always little-endian.
std::optional<TiffStack> metamorph_stack(const BytesAt& bytes_at);

} // namespace isochron::index
