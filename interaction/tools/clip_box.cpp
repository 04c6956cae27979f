// The clip box: its faces, and drawing it.
#include "interaction/tools/clip_box.h"

#include "interaction/tools/plane_hold.h"

namespace isochron::interaction {
namespace {

constexpr glm::vec4 kBoxColor(1.0f, 0.62f, 0.32f, 0.95f);

glm::dvec3 corner_at(const glm::dvec3& index, const DataFrame& data) {
    glm::dvec3 share;
    for (int axis = 0; axis < 3; ++axis)
        share[axis] = data.share_along(axis, index[axis]);
    return data.at(share);
}

} // namespace

std::vector<ClipPlane> cutting_planes(const Settings& settings, const DataFrame& data) {
    std::vector<ClipPlane> planes;
    if (settings.clip.shown)
        planes.push_back(settings.clip);
    const ClipBox& box = settings.clip_box;
    for (int axis = 0; box.shown && axis < 3; ++axis) {
        const glm::dvec3 normal = across(axis, data);
        const bool ahead = glm::dot(normal, glm::dvec3(data.physical_from_box[axis])) > 0;
        const glm::dvec3 up = ahead ? normal : -normal;
        if (box.low[axis] > 0)
            planes.push_back({true, corner_at(box.low, data), -up});
        if (box.high[axis] < data.cells[axis])
            planes.push_back({true, corner_at(box.high, data), up});
    }
    return planes;
}

ClipBox whole_box(const DataFrame& data) {
    return {true, glm::dvec3(0.0), data.cells};
}

ToolDrawing draw_clip_box(const Settings& settings, const DataFrame& data) {
    ToolDrawing drawing;
    const ClipBox& box = settings.clip_box;
    for (int axis = 0; box.shown && axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            glm::dvec3 from = box.low;
            if (edge & 1)
                from[(axis + 1) % 3] = box.high[(axis + 1) % 3];
            if (edge & 2)
                from[(axis + 2) % 3] = box.high[(axis + 2) % 3];
            glm::dvec3 to = from;
            to[axis] = box.high[axis];
            drawing.lines.push_back({corner_at(from, data), corner_at(to, data), kBoxColor});
        }
    return drawing;
}

} // namespace isochron::interaction
