// Color maps that ParaView has exported as JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

/// A color map from a file that a configuration names.
struct LoadedColorMap {
    std::string name;
    /// Colors at equal distances from the lowest to the highest value: sRGB, 0xRRGGBB.
    std::vector<std::uint32_t> colors;
    bool operator==(const LoadedColorMap&) const = default;
};

/// Number of colors that a loaded map is reduced to; between them colors are interpolated in L*a*b*.
inline constexpr std::size_t kLoadedColors = 128;

/// The maps of a file, in its order: `Name`, `RGBPoints` (place, red, green and blue in turn,
/// places ascending, 0 to 1 or not) and `ColorSpace` (`RGB`, `HSV`, `Lab`, `Diverging`, `Step`;
/// others are taken as `Lab`), as ParaView's color map editor exports them.
/// @param name of the file, for messages
/// @throws ConfigError in one line: what is wrong with which map
std::vector<LoadedColorMap> parse_color_maps(const std::string& text, const std::string& name);
/// @throws ConfigError in one line, also when the file cannot be read
std::vector<LoadedColorMap> read_color_maps(const std::filesystem::path& path);

} // namespace isochron::app
