// The interface between the program and its picture module; errors pass as text, not as exceptions.
#pragma once

#include "render/gl/image.h"
#include "stereo/image_module/picture_format.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace isochron::stereo::image_module {

/// @param note stored unchanged in the file; empty: none
/// @param bytes takes the whole file
/// @param error takes the reason if that fails; else unchanged
using Encode = void(const render::Image& image, PictureFormat format, const std::string& note,
                    std::vector<std::byte>& bytes, std::string& error);
/// @param note takes the note; unchanged if there is none
using ReadNote = void(const std::string& path, std::string& note, std::string& error);
using Read = void(const std::string& path, render::Image& image, std::string& error);
/// @param bytes the whole file's
using Decode = void(std::span<const std::byte> bytes, render::Image& image, std::string& error);

constexpr const char* kEncode = "isochron_encode_image";
constexpr const char* kRead = "isochron_read_image";
constexpr const char* kDecode = "isochron_decode_image";
constexpr const char* kReadNote = "isochron_read_note";

} // namespace isochron::stereo::image_module
