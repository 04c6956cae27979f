// What a look comes to.
#include "app/scene/look.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace isochron::app {
namespace {

constexpr glm::vec3 kFloor(0.045f, 0.05f, 0.06f), kSky(0.30f, 0.36f, 0.45f);

constexpr float kTickOpacity = 0.8f;

} // namespace

glm::vec3 light_way(const std::array<double, 2>& angles) {
    const double turn = glm::radians(angles[0]), height = glm::radians(angles[1]);
    return {std::sin(turn) * std::cos(height), std::sin(height), std::cos(turn) * std::cos(height)};
}

std::array<double, 2> light_angles(const glm::vec3& way) {
    const glm::dvec3 unit = glm::normalize(glm::dvec3(way));
    return {glm::degrees(std::atan2(unit.x, unit.z)),
            glm::degrees(std::asin(std::clamp(unit.y, -1.0, 1.0)))};
}

void set_look(render::CellAppearance& appearance, const render::CellAppearance& configured,
              const interaction::Look& look) {
    appearance.reflectance = configured.reflectance;
    appearance.shininess = configured.shininess;
    appearance.ambient = configured.ambient;
    switch (look.material) {
    case interaction::Material::satin: break;
    case interaction::Material::matte:
        appearance.reflectance = 0.0f;
        appearance.shininess = 1.0f;
        break;
    case interaction::Material::glossy:
        appearance.reflectance = 0.08f;
        appearance.shininess = 150.0f;
        break;
    case interaction::Material::metal:
        appearance.reflectance = 0.35f;
        appearance.shininess = 25.0f;
        appearance.ambient = 0.6f * configured.ambient;
        break;
    }
    appearance.occlusion = look.occlusion;
    appearance.key_direction = look.light ? light_way(*look.light) : configured.key_direction;
}

std::optional<render::BackgroundColors> background_of(const interaction::Look& look) {
    switch (look.background) {
    case interaction::Background::dark: break;
    case interaction::Background::light: return render::BackgroundColors{kPaperWhite, kPaperWhite};
    case interaction::Background::white:
        return render::BackgroundColors{glm::vec3(1.0f), glm::vec3(1.0f)};
    case interaction::Background::gradient: return render::BackgroundColors{kFloor, kSky};
    case interaction::Background::gray: return render::BackgroundColors{kLifted, kLifted};
    }
    return std::nullopt;
}

void set_colors(Axes& axes, const OverlayColors& overlay) {
    for (render::Line& line : axes.ticks)
        line.color = glm::vec4(glm::vec3(overlay.text), kTickOpacity);
    const auto set = [&](render::Label& label) {
        label.color = overlay.text;
        label.halo = overlay.halo();
    };
    for (AxisLabels& labels : axes.labels) {
        set(labels.title);
        for (AxisLabels::Number& number : labels.numbers)
            set(number.label);
    }
}

} // namespace isochron::app
