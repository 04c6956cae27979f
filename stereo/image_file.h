// Reads and writes picture files: PNG with display values, EXR in linear light.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace isochron::stereo {

/// Writes the colors without alpha, as windows are opaque: .png as they are (sRGB, 8 bits), .exr
/// converted to linear light (half floats). The file appears complete or not at all. The first call
/// loads the libraries of the formats.
/// @throws render::Error for another extension or an empty picture, index::Error when the file
/// cannot be written; both name the file
/// @param note stored unchanged in the file, for `read_note`; ASCII, empty: none
void write_image(const render::Image& image, const std::filesystem::path& path,
                 const std::string& note = {});
/// The bytes that `write_image` writes. @param path its extension is the format; errors name it
std::vector<std::byte> encoded_image(const render::Image& image, const std::filesystem::path& path,
                                     const std::string& note = {});

/// The note in a picture; empty if it has none. @throws render::Error naming the file
std::string read_note(const std::filesystem::path& path);

/// Reads files of `write_image`, and other PNG and EXR files with one (gray), three or four
/// channels, whatever their names. EXR is converted from linear light to sRGB. Alpha is 255 if the
/// file has none.
/// @throws render::Error naming the file
render::Image read_image(const std::filesystem::path& path);

} // namespace isochron::stereo
