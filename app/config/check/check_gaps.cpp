// Warns of gaps between screens, once for each wall.
#include "app/config/check/check_parts.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

glm::vec3 normal_of_screen(const stereo::Screen& screen) {
    return glm::normalize(
        glm::cross(screen.upper_right - screen.upper_left, screen.upper_left - screen.lower_left));
}

bool in_one_wall(const stereo::Screen& a, const stereo::Screen& b) {
    constexpr float kParallel = 0.999f, kDeep = 0.1f; // cosine, and [m]
    const glm::vec3 normal = normal_of_screen(a);
    return glm::dot(normal, normal_of_screen(b)) > kParallel &&
           std::abs(glm::dot(normal, b.lower_left - a.lower_left)) < kDeep;
}

/// Gaps between the same two walls, or within the same one.
struct GapsOfWalls {
    ScreenGap widest;
    std::size_t count = 1;
};

} // namespace

void check_gaps(const std::vector<ScreenGap>& gaps, const std::string& key, Findings& findings) {
    std::vector<GapsOfWalls> walls;
    for (const ScreenGap& gap : gaps) {
        const auto same = std::ranges::find_if(walls, [&](const GapsOfWalls& known) {
            return in_one_wall(*known.widest.a, *gap.a) && in_one_wall(*known.widest.b, *gap.b);
        });
        if (same == walls.end()) {
            walls.push_back({gap});
            continue;
        }
        ++same->count;
        if (gap.width > same->widest.width)
            same->widest = gap;
    }
    for (const auto& [gap, count] : walls) {
        std::string text = fmt::format(
            "{}: a corner is {:.0f} mm from one of {}, where walls meet within {:.0f} mm",
            gap.name_b, 1000.0f * gap.width, gap.name_a, 1000.0f * kSeam);
        if (count > 1)
            text += fmt::format("; there are {} such gaps: bezel says how wide the frames of the "
                                "displays are",
                                count);
        findings.warn(gap.line, key, text);
    }
}

} // namespace isochron::app
