// Names of the stereo modes and the eyes each of them draws.
#include "stereo/stereo_mode.h"

#include <array>

namespace isochron::stereo {
namespace {

struct ModeRow {
    StereoMode mode;
    std::string_view name;
};
constexpr std::array kModes{
    ModeRow{StereoMode::mono, "mono"},
    ModeRow{StereoMode::left, "left"},
    ModeRow{StereoMode::right, "right"},
    ModeRow{StereoMode::side_by_side, "side_by_side"},
    ModeRow{StereoMode::top_bottom, "top_bottom"},
    ModeRow{StereoMode::anaglyph_red_cyan, "anaglyph_red_cyan"},
};

} // namespace

std::string_view name_of(StereoMode mode) {
    for (const ModeRow& row : kModes)
        if (row.mode == mode)
            return row.name;
    return "?";
}

std::optional<StereoMode> stereo_mode_from_name(std::string_view name) {
    for (const ModeRow& row : kModes)
        if (row.name == name)
            return row.mode;
    return std::nullopt;
}

std::vector<StereoMode> all_stereo_modes() {
    std::vector<StereoMode> modes;
    for (const ModeRow& row : kModes)
        modes.push_back(row.mode);
    return modes;
}

std::vector<Eye> eyes_of(StereoMode mode) {
    switch (mode) {
    case StereoMode::mono: return {Eye::centre};
    case StereoMode::left: return {Eye::left};
    case StereoMode::right: return {Eye::right};
    default: return {Eye::left, Eye::right};
    }
}

} // namespace isochron::stereo
