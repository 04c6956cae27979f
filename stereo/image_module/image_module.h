// What the program and its picture module agree on; errors cross as text, never as exceptions.
#pragma once

#include "render/gl/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::stereo::image_module {

/// @param format `png` or `exr`
/// @param note kept in the file as it is; empty: none
/// @param bytes the whole file; @param error why there is none, else left empty
using Encode = void(const render::Image& image, const std::string& format, const std::string& note,
                    std::vector<std::byte>& bytes, std::string& error);
/// @param note left empty where there is none
using ReadNote = void(const std::string& path, std::string& note, std::string& error);
using Decode = void(const std::string& path, render::Image& image, std::string& error);

constexpr const char* kEncode = "isochron_encode_image";
constexpr const char* kDecode = "isochron_decode_image";
constexpr const char* kReadNote = "isochron_read_note";

} // namespace isochron::stereo::image_module
