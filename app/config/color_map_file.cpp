// Color maps that ParaView has exported as JSON.
#include "app/config/color_map_file.h"

#include "app/config/config_problem.h"
#include "index/error.h"
#include "index/system/input_file.h"
#include "render/gl/srgb.h"
#include "render/passes/cielab.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace isochron::app {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostBytesOfMaps = 16 << 20;
constexpr std::size_t kMostMaps = 256, kMostPoints = 65536;

struct MapPoint {
    double at;
    glm::vec3 color; ///< sRGB
};

glm::vec3 hsv_from(const glm::vec3& rgb) {
    const float high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
    const float chroma = high - low;
    float hue = 0.0f; // in sixths of a turn
    if (chroma > 0.0f)
        hue = high == rgb.x   ? (rgb.y - rgb.z) / chroma
              : high == rgb.y ? 2.0f + (rgb.z - rgb.x) / chroma
                              : 4.0f + (rgb.x - rgb.y) / chroma;
    return {hue < 0.0f ? hue + 6.0f : hue, high > 0.0f ? chroma / high : 0.0f, high};
}

glm::vec3 rgb_from_hsv(const glm::vec3& hsv) {
    const auto channel = [&](float shift) {
        const float k = std::fmod(shift + hsv.x, 6.0f);
        return hsv.z * (1.0f - hsv.y * std::clamp(std::min(k, 4.0f - k), 0.0f, 1.0f));
    };
    return {channel(5.0f), channel(3.0f), channel(1.0f)};
}

/// Between two colors, the short way round where hues are concerned.
glm::vec3 between(const glm::vec3& a, const glm::vec3& b, float share, const std::string& space) {
    if (space == "Step")
        return a;
    if (space == "RGB")
        return glm::mix(a, b, share);
    if (space == "HSV") {
        glm::vec3 from = hsv_from(a), to = hsv_from(b);
        if (std::abs(from.x - to.x) > 3.0f)
            (from.x < to.x ? from.x : to.x) += 6.0f;
        return rgb_from_hsv(glm::mix(from, to, share));
    }
    const auto lab = [](const glm::vec3& color) {
        return render::cielab_from_linear(render::linear_from_srgb(color));
    };
    return render::srgb_from_linear(
        glm::clamp(render::linear_from_cielab(glm::mix(lab(a), lab(b), share)), 0.0f, 1.0f));
}

glm::vec3 color_at(std::span<const MapPoint> points, double at, const std::string& space) {
    const auto above = std::ranges::upper_bound(points, at, {}, &MapPoint::at);
    if (above == points.begin())
        return points.front().color;
    if (above == points.end())
        return points.back().color;
    const MapPoint& below = *(above - 1);
    return between(below.color, above->color,
                   static_cast<float>((at - below.at) / (above->at - below.at)), space);
}

std::uint32_t packed(const glm::vec3& color) {
    const auto byte = [](float value) {
        return static_cast<std::uint32_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
    };
    return byte(color.x) << 16 | byte(color.y) << 8 | byte(color.z);
}

std::vector<MapPoint> points_of(const json& map, const std::string& where) {
    const auto found = map.find("RGBPoints");
    if (found == map.end() || !found->is_array() || found->size() < 8 || found->size() % 4 != 0 ||
        found->size() > 4 * kMostPoints)
        throw ConfigError(
            "{}: RGBPoints: expected a list of numbers, four for each of two points or more",
            where);
    std::vector<MapPoint> points;
    for (std::size_t i = 0; i < found->size(); i += 4) {
        std::array<double, 4> numbers{};
        for (std::size_t k = 0; k < 4; ++k) {
            const json& value = (*found)[i + k];
            numbers[k] = value.is_number() ? value.get<double>() : std::nan("");
            if (!std::isfinite(numbers[k]) || (k > 0 && (numbers[k] < 0 || numbers[k] > 1)))
                throw ConfigError("{}: RGBPoints, number {}: expected {}, got {}", where, i + k,
                                  k > 0 ? "a color from 0 to 1" : "a place",
                                  value.dump().substr(0, 40));
        }
        if (!points.empty() && !(numbers[0] > points.back().at))
            throw ConfigError("{}: RGBPoints, number {}: expected a place above {}, got {}", where,
                              i, points.back().at, numbers[0]);
        points.push_back({numbers[0], glm::vec3(numbers[1], numbers[2], numbers[3])});
    }
    return points;
}

LoadedColorMap map_of(const json& map, const std::string& file, std::size_t number) {
    if (!map.is_object())
        throw ConfigError("{}: map {}: expected an object", file, number);
    LoadedColorMap loaded;
    const auto name = map.find("Name");
    if (name == map.end() || !name->is_string() || name->get<std::string>().empty() ||
        name->get<std::string>().size() > 64)
        throw ConfigError("{}: map {}: Name: expected a text of 1 to 64 bytes", file, number);
    loaded.name = name->get<std::string>();
    const std::vector<MapPoint> points =
        points_of(map, fmt::format("{}: map '{}'", file, loaded.name));
    const auto given = map.find("ColorSpace");
    const std::string space =
        given != map.end() && given->is_string() ? given->get<std::string>() : "Lab";
    for (std::size_t i = 0; i < kLoadedColors; ++i)
        loaded.colors.push_back(packed(
            color_at(points,
                     std::lerp(points.front().at, points.back().at,
                               static_cast<double>(i) / static_cast<double>(kLoadedColors - 1)),
                     space)));
    return loaded;
}

} // namespace

std::vector<LoadedColorMap> parse_color_maps(const std::string& text, const std::string& name) {
    const json maps = json::parse(text, nullptr, false);
    if (maps.is_discarded())
        throw ConfigError("{}: expected color maps as ParaView exports them, in JSON", name);
    const json list = maps.is_array() ? maps : json::array({maps});
    if (list.empty() || list.size() > kMostMaps)
        throw ConfigError("{}: expected 1 to {} color maps, got {}", name, kMostMaps, list.size());
    std::vector<LoadedColorMap> loaded;
    for (std::size_t i = 0; i < list.size(); ++i)
        loaded.push_back(map_of(list[i], name, i));
    return loaded;
}

std::vector<LoadedColorMap> read_color_maps(const std::filesystem::path& path) {
    try {
        return parse_color_maps(index::read_text(path, kMostBytesOfMaps), path.string());
    } catch (const index::Error& error) {
        throw ConfigError(error.what());
    }
}

} // namespace isochron::app
