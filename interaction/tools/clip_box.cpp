// The clip box: its faces, and drawing it.
#include "interaction/tools/clip_box.h"

#include "interaction/navigation/navigation.h"
#include "interaction/tools/plane_hold.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

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
    for (int axis = 0; box.shown && axis < 3; ++axis)
        for (const bool high : {false, true}) {
            if (high ? !(box.high[axis] < data.cells[axis]) : !(box.low[axis] > 0))
                continue; // it cuts nothing
            const Plane plane = plane_of({axis, high}, box, data);
            planes.push_back({true, plane.point, plane.normal});
        }
    return planes;
}

Plane plane_of(const BoxFace& face, const ClipBox& box, const DataFrame& data) {
    glm::dvec3 normal = across(face.axis, data);
    if ((glm::dot(normal, glm::dvec3(data.physical_from_box[face.axis])) > 0) != face.high)
        normal = -normal;
    return {corner_at(face.high ? box.high : box.low, data), normal};
}

std::optional<BoxFace> face_met(const ClipBox& box, const Pose& ray, const ToolContext& now) {
    constexpr double kBeside = 1e-6; // cells
    const DataFrame& data = now.session.data;
    std::optional<BoxFace> first;
    double nearest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            const auto met = meeting_of(ray, plane_of({axis, high}, box, data), now);
            if (!met || met->along >= nearest)
                continue;
            const glm::dvec3 share = data.in_box(in_physical(now.room_from_physical, met->at));
            bool within = true;
            for (int other = 0; other < 3; ++other) {
                const double index = data.index_along(other, share[other]);
                within = within && (other == axis || (index >= box.low[other] - kBeside &&
                                                      index <= box.high[other] + kBeside));
            }
            if (!within)
                continue;
            nearest = met->along;
            first = BoxFace{axis, high};
        }
    return first;
}

ClipBox with_face(ClipBox box, const BoxFace& face, const Plane& plane, const DataFrame& data) {
    constexpr double kThinnest = 0.01; // cells
    const double at = data.index_along(face.axis, data.in_box(plane.point)[face.axis]);
    const double cells = data.cells[face.axis];
    if (face.high)
        box.high[face.axis] = std::clamp(at, box.low[face.axis] + kThinnest, cells);
    else
        box.low[face.axis] = std::clamp(at, 0.0, box.high[face.axis] - kThinnest);
    return box;
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
