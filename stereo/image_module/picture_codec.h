// The two formats of pictures, each by the library that defines it.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::stereo::image_module {

/// A picture with more pixels is refused: that is what a lying header asks for, not a display.
constexpr std::size_t kMostPixels = std::size_t{1} << 28;

/// How a text is named among a file's attributes.
constexpr const char* kNote = "isochron";

/// All throw std::exception with one line that does not name the file. `note` is ASCII, empty for
/// none. Three channels are written; one (gray), three or four are read.
std::vector<std::byte> encode_png(const render::Image& image, const std::string& note);
render::Image decode_png(const std::string& path);
std::string png_note(const std::string& path);

/// Half floats of linear light.
std::vector<std::byte> encode_exr(const render::Image& image, const std::string& note);
render::Image decode_exr(const std::string& path);
std::string exr_note(const std::string& path);

} // namespace isochron::stereo::image_module
