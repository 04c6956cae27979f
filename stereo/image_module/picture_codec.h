// The codecs of the two picture formats, each by its reference library.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::stereo::image_module {

/// Pictures with more pixels are refused: no display has as many, so the header must be wrong.
constexpr std::size_t kMostPixels = std::size_t{1} << 28;

/// The name of the note among a file's attributes.
constexpr const char* kNote = "isochron";

/// All throw std::exception with one line, which does not name the file. `note` is ASCII; empty:
/// none. They write three channels, and read one (gray), three or four.
std::vector<std::byte> encode_png(const render::Image& image, const std::string& note);
render::Image decode_png(const std::string& path);
std::string png_note(const std::string& path);

/// Writes linear light as half floats.
std::vector<std::byte> encode_exr(const render::Image& image, const std::string& note);
render::Image decode_exr(const std::string& path);
std::string exr_note(const std::string& path);

} // namespace isochron::stereo::image_module
