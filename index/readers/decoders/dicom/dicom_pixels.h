// The pixels of DICOM files, decoded by GDCM.
#pragma once

#include "index/readers/decoders/dicom/dicom_image.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace isochron::index {

/// Keeps the pixels of the file that was read last.
class DicomPixels {
  public:
    /// Whether a frame can be read without the others.
    static bool by_frame(const DicomFile& file) { return file.pixels_at != 0; }

    /// One sample of every pixel of a frame; stored bits that do not belong to the value are gone.
    /// @param out columns * rows values of the file's type, native byte order
    /// @throws Error naming the file: damaged, or other pixels than its header has
    void read(const std::filesystem::path& path, const DicomFile& file, std::uint32_t frame,
              std::size_t sample, std::span<std::byte> out);

  private:
    void decode(const std::filesystem::path& path, const DicomFile& file, std::uint32_t frame);

    std::filesystem::path decoded_; ///< the file that `pixels_` are of
    std::uint32_t frame_ = 0;       ///< the frame that they begin with
    bool planar_ = false;           ///< samples lie apart, each frame for itself
    std::vector<char> pixels_;
};

} // namespace isochron::index
