// Names of the stereo modes and the eyes each of them draws.
#include "stereo/stereo_mode.h"

#include <algorithm>
#include <array>

namespace isochron::stereo {
namespace {

using enum StereoMode;

/// A word for a mode; the first row of a mode holds its name, further ones what else is understood.
struct ModeRow {
    StereoMode mode;
    std::string_view name;
    StereoMode upright;
};
constexpr std::array kModes{
    ModeRow{mono, "mono", mono},
    ModeRow{left, "left", left},
    ModeRow{right, "right", right},
    ModeRow{quadbuffer, "quadbuffer", quadbuffer},
    ModeRow{side_by_side, "side_by_side", side_by_side},
    ModeRow{top_bottom, "top_bottom", top_bottom},
    ModeRow{anaglyph_red_cyan, "anaglyph_red_cyan", anaglyph_red_cyan},
    ModeRow{anaglyph_dubois, "anaglyph_dubois", anaglyph_dubois},
    ModeRow{vertical_interlaced, "vertical_interlaced", vertical_interlaced},
    ModeRow{horizontal_interlaced, "horizontal_interlaced", horizontal_interlaced},
    ModeRow{checkerboard, "checkerboard", checkerboard},
    ModeRow{quadbuffer_inverted, "quadbuffer_inverted", quadbuffer},
    ModeRow{side_by_side_inverted, "side_by_side_inverted", side_by_side},
    ModeRow{top_bottom_inverted, "top_bottom_inverted", top_bottom},
    ModeRow{anaglyph_red_cyan_inverted, "anaglyph_red_cyan_inverted", anaglyph_red_cyan},
    ModeRow{anaglyph_dubois_inverted, "anaglyph_dubois_inverted", anaglyph_dubois},
    ModeRow{vertical_interlaced_inverted, "vertical_interlaced_inverted", vertical_interlaced},
    ModeRow{horizontal_interlaced_inverted, "horizontal_interlaced_inverted",
            horizontal_interlaced},
    ModeRow{checkerboard_inverted, "checkerboard_inverted", checkerboard},
    ModeRow{mono, "mono_inverted", mono},
    ModeRow{right, "left_inverted", right},
    ModeRow{left, "right_inverted", left},
};

const ModeRow& row_of(StereoMode mode) {
    return *std::ranges::find(kModes, mode, &ModeRow::mode); // every mode has a row
}

} // namespace

std::string_view name_of(StereoMode mode) {
    return row_of(mode).name;
}

std::string_view name_of(Eye eye) {
    return eye == Eye::left ? "left" : eye == Eye::right ? "right" : "center";
}

std::optional<StereoMode> stereo_mode_from_name(std::string_view name) {
    const auto row = std::ranges::find(kModes, name, &ModeRow::name);
    return row == kModes.end() ? std::nullopt : std::optional(row->mode);
}

std::vector<StereoMode> all_stereo_modes() {
    std::vector<StereoMode> modes;
    for (const ModeRow& row : kModes)
        if (name_of(row.mode) == row.name)
            modes.push_back(row.mode);
    return modes;
}

std::vector<std::string_view> stereo_mode_words() {
    std::vector<std::string_view> words;
    for (const ModeRow& row : kModes)
        words.push_back(row.name);
    return words;
}

bool is_inverted(StereoMode mode) {
    return upright(mode) != mode;
}

StereoMode upright(StereoMode mode) {
    return row_of(mode).upright;
}

std::vector<Eye> eyes_of(StereoMode mode) {
    switch (mode) {
    case StereoMode::mono: return {Eye::center};
    case StereoMode::left: return {Eye::left};
    case StereoMode::right: return {Eye::right};
    default: return {Eye::left, Eye::right};
    }
}

Eye place_of(Eye eye, StereoMode mode) {
    if (eye == Eye::center || !is_inverted(mode))
        return eye;
    return eye == Eye::left ? Eye::right : Eye::left;
}

} // namespace isochron::stereo
