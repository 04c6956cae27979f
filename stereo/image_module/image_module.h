// What the program and its picture module agree on; errors cross as text, never as exceptions.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::stereo::image_module {

/// @param format `png` or `exr`
/// @param bytes the whole file; @param error why there is none, else left empty
using Encode = void(const render::Image& image, const std::string& format,
                    std::vector<std::byte>& bytes, std::string& error);
using Decode = void(const std::string& path, render::Image& image, std::string& error);

constexpr const char* kEncode = "isochron_encode_image";
constexpr const char* kDecode = "isochron_decode_image";

} // namespace isochron::stereo::image_module
