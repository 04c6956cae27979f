// Stereo modes: the ways to show two eyes' pictures in one window.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::stereo {

/// Rows and columns count from the window's top left pixel (row 0, column 0), which belongs to the
/// left eye, wherever a viewport begins. Modes with two eyes also exist with exchanged eyes, see
/// `inverted`.
enum class StereoMode : std::uint8_t {
    mono,                  ///< one eye, midway between the two
    left,                  ///< only the left eye
    right,                 ///< only the right eye
    quadbuffer,            ///< the window's left and right buffers, each of its full size
    side_by_side,          ///< left half, right half
    top_bottom,            ///< upper half, lower half
    anaglyph_red_cyan,     ///< red from the left eye, green and blue from the right one
    anaglyph_dubois,       ///< for the same glasses, with less ghosting and truer colors
    vertical_interlaced,   ///< rows alternate, even ones left (SGCT's name: down the window)
    horizontal_interlaced, ///< columns alternate, even ones left
    checkerboard           ///< pixels alternate both ways, left where row + column is even
};

enum class Eye : std::uint8_t { center, left, right };

/// `checkerboard`, `checkerboard_inverted`
std::string_view name_of(StereoMode mode);
std::string_view name_of(Eye eye); ///< `left`, as in file names
/// Also accepts `mono_inverted` (`mono`), `left_inverted` (`right`) and `right_inverted` (`left`).
std::optional<StereoMode> stereo_mode_from_name(std::string_view name);
std::vector<StereoMode> all_stereo_modes();
/// Every name that `stereo_mode_from_name` accepts.
std::vector<std::string_view> stereo_mode_words();

/// The mode with exchanged eyes: mono stays mono, left becomes right.
StereoMode inverted(StereoMode mode);
/// Whether a mode with two eyes has them exchanged.
bool is_inverted(StereoMode mode);
/// The mode with the eyes in their usual places.
StereoMode upright(StereoMode mode);

/// Which eyes are drawn, in order: mono draws the center eye, `left` only the left one, ...
std::vector<Eye> eyes_of(StereoMode mode);

/// In which eye's place the picture of `eye` is shown: the other eye's if the mode is inverted.
Eye place_of(Eye eye, StereoMode mode);

} // namespace isochron::stereo
