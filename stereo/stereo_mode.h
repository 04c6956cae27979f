// The ways of bringing two eyes' pictures to one window.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace isochron::stereo {

/// Rows and columns are counted from the window's top left pixel, which is row 0 and column 0 and
/// belongs to the left eye, wherever a viewport begins. Modes of two eyes also exist with the eyes
/// exchanged, see `inverted`.
enum class StereoMode : std::uint8_t {
    mono,                  ///< one eye, midway between the two
    left,                  ///< the left eye alone
    right,                 ///< the right eye alone
    quadbuffer,            ///< a left and a right buffer of the window's own, each of its full size
    side_by_side,          ///< left half, right half
    top_bottom,            ///< upper half, lower half
    anaglyph_red_cyan,     ///< red from the left eye, green and blue from the right one
    anaglyph_dubois,       ///< for the same glasses, with less ghosting and truer colors
    vertical_interlaced,   ///< rows alternate, even ones left (SGCT's word: down the window)
    horizontal_interlaced, ///< columns alternate, even ones left
    checkerboard           ///< pixels alternate both ways, left where row + column is even
};

enum class Eye : std::uint8_t { center, left, right };

/// `checkerboard`, `checkerboard_inverted`
std::string_view name_of(StereoMode mode);
std::string_view name_of(Eye eye); ///< `left`, as in file names
/// Also knows `mono_inverted`, which is `mono`, and `left_inverted`, which is `right`, and the
/// other way round.
std::optional<StereoMode> stereo_mode_from_name(std::string_view name);
std::vector<StereoMode> all_stereo_modes();
/// Every word that `stereo_mode_from_name` knows.
std::vector<std::string_view> stereo_mode_words();

/// The mode with its eyes exchanged: mono stays mono, and left becomes right.
StereoMode inverted(StereoMode mode);
/// Whether a mode of two eyes has them exchanged.
bool is_inverted(StereoMode mode);
/// The mode with its eyes in their usual places.
StereoMode upright(StereoMode mode);

/// Which eyes are drawn, in order: mono draws the center eye, `left` the left one alone, ...
std::vector<Eye> eyes_of(StereoMode mode);

/// The eye whose picture is drawn and the one in whose place it is shown: the other one where the
/// mode is inverted.
Eye place_of(Eye eye, StereoMode mode);

} // namespace isochron::stereo
