// The pixels of a view that show a box in the room.
#include "render/passes/pixel_box.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace isochron::render {

PixelBox pixel_box(const View& view, const glm::mat4& room_from_box) {
    const glm::mat4 clip_from_box = view.clip_from_eye * view.eye_from_room * room_from_box;
    glm::vec2 low(1.0f), high(-1.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 at =
            clip_from_box * glm::vec4(corner & 1, corner >> 1 & 1, corner >> 2, 1.0f);
        if (at.w <= 0.0f)
            return {view.corner, view.corner + view.size};
        const glm::vec2 place = glm::clamp(glm::vec2(at) / at.w, -1.0f, 1.0f);
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const glm::vec2 size(view.size);
    const auto pixel = [&](glm::vec2 place) { return 0.5f * (place + 1.0f) * size; };
    return {view.corner + glm::ivec2(glm::floor(pixel(low))),
            view.corner +
                glm::max(glm::ivec2(glm::ceil(pixel(high))), glm::ivec2(glm::floor(pixel(low))))};
}

} // namespace isochron::render
