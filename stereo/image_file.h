// Reads and writes picture files: PNG, TIFF and JPEG with display values, EXR in linear light.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace isochron::stereo {

/// Whether a path has the extension of a picture, in upper or lower case: .png, .exr, .tif, .tiff,
/// .jpg or .jpeg.
bool is_picture_name(const std::filesystem::path& path);

/// Writes the colors, and alpha where a picture is not opaque and the format has it (.png, .tiff; the
/// others are over white): .png, .tif and .tiff as they are (sRGB,
/// 8 bits), .jpg and .jpeg with the losses of JPEG, .exr converted to linear light (half floats).
/// The file appears complete or not at all. The first call loads OpenImageIO, which takes a fifth
/// of a second.
/// @throws render::Error for another extension, an empty picture, or a picture or a note that is
/// too large for the format; index::Error when the file cannot be written or OpenImageIO is not
/// there; all name the file
/// @param note stored unchanged in the file, for `read_note`; ASCII, empty: none
void write_image(const render::Image& image, const std::filesystem::path& path,
                 const std::string& note = {});
/// The bytes that `write_image` writes. @param path its extension is the format; errors name it
std::vector<std::byte> encoded_image(const render::Image& image, const std::filesystem::path& path,
                                     const std::string& note = {});

/// The note in a picture; empty if it has none. In a TIFF or a JPEG of another program it is the
/// description of the picture. @throws render::Error naming the file
std::string read_note(const std::filesystem::path& path);

/// Reads files of `write_image`, and other files of these formats with one channel (gray), two
/// (gray and alpha), three or four, whatever their names. Floats are converted from linear light to
/// sRGB. Alpha is 255 if the file has none.
/// @throws render::Error naming the file
render::Image read_image(const std::filesystem::path& path);
/// Reads an image from a file's bytes. @param path named by errors
render::Image decoded_image(std::span<const std::byte> bytes, const std::filesystem::path& path);

} // namespace isochron::stereo
