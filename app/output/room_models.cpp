// Models for the picture of an emulated room.
#include "app/output/room_models.h"

#include <cmath>

namespace isochron::app {
namespace {

constexpr float kGridSpacing = 0.5f;  ///< [m]
constexpr float kGridHeight = -0.01f; ///< [m] just below a screen on the floor
constexpr glm::vec4 kGrid(0.45f, 0.48f, 0.52f, 0.6f);
constexpr glm::vec3 kEyeWhite(0.95f), kPupil(0.1f), kWand(0.85f, 0.62f, 0.25f);

void append(std::vector<render::Triangle>& into, const std::vector<render::Triangle>& more) {
    into.insert(into.end(), more.begin(), more.end());
}

} // namespace

std::vector<render::Triangle> head_model(glm::vec3 color) {
    std::vector<render::Triangle> model =
        render::ellipsoid({0.0f, 0.0f, 0.085f}, {0.075f, 0.115f, 0.1f}, color);
    for (const float side : {-1.0f, 1.0f}) {
        append(model, render::ellipsoid({0.032f * side, 0.0f, 0.0f}, glm::vec3(0.016f), kEyeWhite));
        append(model, render::ellipsoid({0.032f * side, 0.0f, -0.011f}, glm::vec3(0.008f), kPupil));
    }
    append(model,
           render::pyramid({glm::vec3(0.0f, 0.0f, 0.0f), glm::vec3(0.02f, -0.05f, -0.005f),
                            glm::vec3(0.0f, -0.055f, 0.0f), glm::vec3(-0.02f, -0.05f, -0.005f)},
                           {0.0f, -0.045f, -0.05f}, color));
    return model;
}

std::vector<render::Triangle> wand_model() {
    std::vector<render::Triangle> model =
        render::solid_box({-0.02f, -0.02f, 0.0f}, {0.02f, 0.02f, 0.16f}, kWand);
    append(model, render::pyramid({glm::vec3(-0.03f, -0.03f, 0.0f), glm::vec3(-0.03f, 0.03f, 0.0f),
                                   glm::vec3(0.03f, 0.03f, 0.0f), glm::vec3(0.03f, -0.03f, 0.0f)},
                                  {0.0f, 0.0f, -0.08f}, kWand));
    return model;
}

std::vector<render::Line> floor_grid(glm::vec2 low, glm::vec2 high) {
    std::vector<render::Line> lines;
    const auto step = [](float at) { return std::lround(at / kGridSpacing); };
    for (long i = step(low.x); i <= step(high.x); ++i) {
        const float x = kGridSpacing * static_cast<float>(i);
        lines.push_back({{x, kGridHeight, low.y}, {x, kGridHeight, high.y}, kGrid});
    }
    for (long i = step(low.y); i <= step(high.y); ++i) {
        const float z = kGridSpacing * static_cast<float>(i);
        lines.push_back({{low.x, kGridHeight, z}, {high.x, kGridHeight, z}, kGrid});
    }
    return lines;
}

} // namespace isochron::app
