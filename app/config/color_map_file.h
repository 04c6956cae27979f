// Color maps that ParaView has exported as JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

/// A color map that a configuration brings along.
struct LoadedColorMap {
    std::string name;
    /// At equal distances from low to high: sRGB, eight bits each of red, green and blue from the
    /// highest.
    std::vector<std::uint32_t> colors;
    bool operator==(const LoadedColorMap&) const = default;
};

/// Places at which a loaded map is kept: straight in L*a*b* between them.
inline constexpr std::size_t kLoadedColors = 128;

/// The maps of a file, in its order: `Name`, `RGBPoints` (place, red, green and blue in turn, places
/// ascending, 0 to 1 or not) and `ColorSpace` (`RGB`, `HSV`, `Lab`, `Diverging`, `Step`; others are
/// taken as `Lab`), as ParaView's color map editor exports them.
/// @param name of the file, for messages
/// @throws ConfigError in one line: what is wrong with which map
std::vector<LoadedColorMap> parse_color_maps(const std::string& text, const std::string& name);
/// @throws ConfigError likewise, or when the file cannot be read
std::vector<LoadedColorMap> read_color_maps(const std::filesystem::path& path);

} // namespace isochron::app
