// The small picture that a kept session has of what was seen last.
#pragma once

#include "render/gl/image.h"

#include <optional>
#include <string>
#include <string_view>

namespace isochron::app {

/// Largest small picture [pixel].
inline constexpr int kPictureWidth = 160, kPictureHeight = 100;

/// A picture made smaller, each pixel the mean of those that it stands for, so that it is no larger
/// than a small picture; with its proportions, and never enlarged. An empty one stays empty.
render::Image made_small(const render::Image& picture);

/// The bytes of a picture as a PNG, which needs no library that would have to be loaded: a session is
/// saved within the time that a signal leaves. @param picture not empty
std::string png_of(const render::Image& picture);
/// The picture in these bytes; empty: they are no PNG, or nothing here can read it.
std::optional<render::Image> picture_in(const std::string& png);

/// Bytes in base64 (RFC 4648), and back. @return empty: the text is none
std::string to_base64(std::string_view bytes);
std::optional<std::string> from_base64(std::string_view text);

} // namespace isochron::app
