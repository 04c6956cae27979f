// Where the pixels of a DICOM file begin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace isochron::index {

/// How the elements of a data set are written: parts of the transfer syntax.
struct DicomCoding {
    bool with_kinds = true; ///< explicit value representations
    bool big_endian = false;
};

struct PixelPlace {
    std::uint64_t at = 0;    ///< [bytes] from the start of the file
    std::uint64_t bytes = 0; ///< size that the element states
    bool packed = false;     ///< compressed: in fragments, without a length of the whole
};

/// Walks over the elements of the file. @return none: it has no pixels, or is damaged before them
std::optional<PixelPlace> place_of_pixels(const std::filesystem::path& path,
                                          const DicomCoding& coding);

} // namespace isochron::index
