// Pictures of all directions from flat views.
#include "app/output/panorama.h"

#include "interaction/navigation/navigation.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isochron::app {
namespace {

/// Columns of a sector: for what is 1 m away, eyes that stand 0.0315 m beside the axis and see half
/// of so many columns to the side move by less than half a pixel.
constexpr int kColumnsOfSector = 45;
constexpr double kTilt = glm::quarter_pi<double>(); ///< [rad] of a view's middle, up or down
constexpr double kBorder = 2;                       ///< [pixel] of a view beyond what it is for
constexpr double kFarScreen = 1000; ///< [m]: eyes beside the head see the same of it

/// The axes of a view in the head's frame.
struct ViewAxes {
    glm::dvec3 ahead, up;
    explicit ViewAxes(bool upper) {
        const double rise = upper ? std::sin(kTilt) : -std::sin(kTilt);
        ahead = {0, rise, -std::cos(kTilt)};
        up = {0, std::cos(kTilt), rise};
    }
};

} // namespace

PanoramaPlan::PanoramaPlan(glm::ivec2 size)
    : size_(size),
      sectors_(static_cast<std::size_t>((size.x + kColumnsOfSector - 1) / kColumnsOfSector)) {
    if (size.x != size.y || size.x < kNarrowest || size.x % 2 != 0)
        throw std::invalid_argument("a panorama for both eyes is an even square");
    const double per_radian = size.x / glm::two_pi<double>();
    const double half_sector =
        (static_cast<double>(size.x) / static_cast<double>(sectors_) + 1) / 2 / per_radian;
    const double border = kBorder / per_radian;
    extent_ = {std::tan(half_sector) / std::cos(kTilt) + border, std::tan(kTilt) + border};
    view_ = glm::ivec2(glm::ceil(2.0 * per_radian * extent_));
}

double PanoramaPlan::middle_of(std::size_t sector) const {
    const auto [first, end] = columns(sector);
    return (0.5 * (first + end) / size_.x - 0.5) * glm::two_pi<double>();
}

std::pair<int, int> PanoramaPlan::columns(std::size_t sector) const {
    const auto at = [&](std::size_t border) {
        return static_cast<int>(border * static_cast<std::size_t>(size_.x) / sectors_);
    };
    return {at(sector), at(sector + 1)};
}

void PanoramaPlan::prepare(stereo::Installation& installation) const {
    stereo::Window window;
    window.size = 2 * view_;
    window.stereo = stereo::StereoMode::top_bottom;
    window.viewports.clear();
    for (const bool upper : {true, false}) {
        const ViewAxes axes(upper);
        const auto corner = [&](double x, double y) {
            return glm::vec3(kFarScreen * (axes.ahead + glm::dvec3(x * extent_.x, 0, 0) +
                                           y * extent_.y * axes.up));
        };
        stereo::Viewport& viewport = window.viewports.emplace_back();
        viewport.name = upper ? "upper" : "lower";
        viewport.position = {upper ? 0.0f : 0.5f, 0.0f};
        viewport.size = {0.5f, 1.0f};
        viewport.screen.lower_left = corner(-1, -1);
        viewport.screen.upper_left = corner(-1, 1);
        viewport.screen.upper_right = corner(1, 1);
        viewport.screen.carried_by_head = true;
    }
    installation.windows = {window};
}

interaction::InputState PanoramaPlan::turned(interaction::InputState input,
                                             const stereo::Viewer& viewer,
                                             std::size_t sector) const {
    auto head = std::ranges::find(input.devices, viewer.head, &interaction::DeviceState::name);
    if (head == input.devices.end()) {
        head = input.devices.emplace(head);
        head->name = viewer.head;
    }
    const interaction::Pose before =
        head->pose.value_or(interaction::Pose{viewer.position, {1, 0, 0, 0}});
    const double turn = interaction::heading(before) - middle_of(sector);
    head->pose =
        interaction::Pose{before.position, glm::quat(glm::angleAxis(turn, glm::dvec3(0, 1, 0)))};
    return input;
}

glm::dvec2 PanoramaPlan::place_in_view(double azimuth, double elevation, std::size_t sector,
                                       bool upper) const {
    const double aside = azimuth - middle_of(sector);
    const glm::dvec3 way(std::cos(elevation) * std::sin(aside), std::sin(elevation),
                         -std::cos(elevation) * std::cos(aside));
    const ViewAxes axes(upper);
    const double away = glm::dot(way, axes.ahead);
    return 0.5 + 0.5 * glm::dvec2(way.x, glm::dot(way, axes.up)) / away / extent_;
}

PanoramaSheet::PanoramaSheet(const PanoramaPlan& plan) : plan_(plan) {
    sheet_.width = plan.size().x;
    sheet_.height = plan.size().y;
    sheet_.rgba.assign(std::size_t{4} * sheet_.width * sheet_.height, 255);
}

void PanoramaSheet::add(std::size_t sector, const PicturePart& part, const render::Image& view) {
    const bool upper = part.viewport == 0;
    const int rows = sheet_.height / 2, half = rows / 2;
    const int top = part.shows == "right" ? rows : 0;
    const auto [first, end] = plan_.columns(sector);
    for (int row = upper ? 0 : half; row < (upper ? half : rows); ++row) {
        const double elevation = (0.5 - (row + 0.5) / rows) * glm::pi<double>();
        for (int column = first; column < end; ++column) {
            const double azimuth = ((column + 0.5) / sheet_.width - 0.5) * glm::two_pi<double>();
            const glm::dvec2 at = plan_.place_in_view(azimuth, elevation, sector, upper);
            const double x = std::clamp(at.x * view.width - 0.5, 0.0, view.width - 1.001);
            const double y = std::clamp((1 - at.y) * view.height - 0.5, 0.0, view.height - 1.001);
            const int left = static_cast<int>(x), above = static_cast<int>(y);
            const double fx = x - left, fy = y - above;
            std::uint8_t* const to =
                sheet_.rgba.data() +
                4 * (static_cast<std::size_t>(top + row) * sheet_.width + column);
            for (int c = 0; c < 3; ++c) {
                const double upper_row =
                    std::lerp(double(view.at(left, above)[c]), view.at(left + 1, above)[c], fx);
                const double lower_row = std::lerp(double(view.at(left, above + 1)[c]),
                                                   view.at(left + 1, above + 1)[c], fx);
                to[c] = static_cast<std::uint8_t>(std::lround(std::lerp(upper_row, lower_row, fy)));
            }
        }
    }
}

} // namespace isochron::app
