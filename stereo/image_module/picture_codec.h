// Encoding and decoding of pictures by OpenImageIO.
#pragma once

#include "render/gl/image.h"
#include "stereo/image_module/picture_format.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace isochron::stereo::image_module {

/// Pictures with more pixels are refused: no display has as many, so the header must be wrong.
constexpr std::size_t kMostPixels = std::size_t{1} << 28;

/// Before anything else is done: how OpenImageIO is to work.
void set_up_library();
/// OpenImageIO's name of a format.
const char* library_name_of(PictureFormat format);
/// The attribute that holds the note in pictures of a format.
const char* note_attribute_of(PictureFormat format);

/// All throw std::exception with one line, which does not name the file. `note` is ASCII; empty:
/// none. Three channels are written; one (gray), two (gray and alpha), three or four are read.
std::vector<std::byte> encode(const render::Image& image, PictureFormat format,
                              const std::string& note);
render::Image read(const std::string& path);
render::Image decode(std::span<const std::byte> bytes);
std::string note_of(const std::string& path);

} // namespace isochron::stereo::image_module
