// Names of the stereo modes, and the eyes that each draws.
#include "stereo/stereo_mode.h"

#include <array>
#include <string>

namespace isochron::stereo {
namespace {

constexpr std::array<std::string_view, 11> kModeNames{"mono",
                                                      "left",
                                                      "right",
                                                      "quadbuffer",
                                                      "side_by_side",
                                                      "top_bottom",
                                                      "anaglyph_red_cyan",
                                                      "anaglyph_dubois",
                                                      "vertical_interlaced",
                                                      "horizontal_interlaced",
                                                      "checkerboard"};
static_assert(kModeNames.size() == static_cast<std::size_t>(StereoMode::checkerboard) + 1);

/// The bit by which an inverted mode differs from its upright mode.
constexpr std::uint8_t kInverted = 0x80;

std::size_t number_of(StereoMode mode) {
    return static_cast<std::size_t>(upright(mode));
}

const std::string& inverted_name(StereoMode mode) {
    static const auto names = [] {
        std::array<std::string, kModeNames.size()> all;
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = std::string(kModeNames[i]) + "_inverted";
        return all;
    }();
    return names[number_of(mode)];
}

std::vector<StereoMode> upright_modes() {
    std::vector<StereoMode> modes;
    for (std::size_t i = 0; i < kModeNames.size(); ++i)
        modes.push_back(static_cast<StereoMode>(i));
    return modes;
}

} // namespace

std::string_view name_of(StereoMode mode) {
    return is_inverted(mode) ? inverted_name(mode) : kModeNames[number_of(mode)];
}

std::string_view name_of(Eye eye) {
    return eye == Eye::left ? "left" : eye == Eye::right ? "right" : "center";
}

std::optional<StereoMode> stereo_mode_from_name(std::string_view name) {
    for (const StereoMode mode : upright_modes()) {
        if (name == kModeNames[number_of(mode)])
            return mode;
        if (name == inverted_name(mode))
            return inverted(mode);
    }
    return std::nullopt;
}

std::vector<StereoMode> all_stereo_modes() {
    std::vector<StereoMode> modes = upright_modes();
    for (const StereoMode mode : upright_modes())
        if (is_inverted(inverted(mode)))
            modes.push_back(inverted(mode));
    return modes;
}

std::vector<std::string_view> stereo_mode_words() {
    std::vector<std::string_view> words;
    for (const StereoMode mode : all_stereo_modes())
        words.push_back(name_of(mode));
    for (const StereoMode mode : upright_modes())
        if (!is_inverted(inverted(mode)))
            words.emplace_back(inverted_name(mode));
    return words;
}

StereoMode inverted(StereoMode mode) {
    switch (mode) {
    case StereoMode::mono: return StereoMode::mono;
    case StereoMode::left: return StereoMode::right;
    case StereoMode::right: return StereoMode::left;
    default: return static_cast<StereoMode>(static_cast<std::uint8_t>(mode) ^ kInverted);
    }
}

bool is_inverted(StereoMode mode) {
    return (static_cast<std::uint8_t>(mode) & kInverted) != 0;
}

StereoMode upright(StereoMode mode) {
    return static_cast<StereoMode>(static_cast<std::uint8_t>(mode) & ~kInverted);
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
