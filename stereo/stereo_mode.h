// The ways of bringing two eyes' pictures to one window.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::stereo {

enum class StereoMode : std::uint8_t {
    mono,
    left,
    right,
    side_by_side,
    top_bottom,
    anaglyph_red_cyan
};
enum class Eye : std::uint8_t { centre, left, right };

std::string_view name_of(StereoMode mode);
std::optional<StereoMode> stereo_mode_from_name(std::string_view name);
std::vector<StereoMode> all_stereo_modes();

/// Which eyes are drawn, in order: mono draws the centre eye, `left` the left one alone, ...
std::vector<Eye> eyes_of(StereoMode mode);

} // namespace isochron::stereo
