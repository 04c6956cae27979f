// Compares pictures of surfaces pixel by pixel.
#include "tests/render/cells/surface_agreement.h"

#include <algorithm>
#include <cmath>

namespace isochron::render {

void Agreement::add(const Agreement& other) {
    hit += other.hit;
    hit_by_one += other.hit_by_one;
    elsewhere += other.elsewhere;
    depth_errors.insert(depth_errors.end(), other.depth_errors.begin(), other.depth_errors.end());
    angles.insert(angles.end(), other.angles.begin(), other.angles.end());
}

double Agreement::percentile(std::vector<double> values, double share) {
    if (values.empty())
        return 0.0;
    const auto nth = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

Agreement compare(const SurfacePicture& picture, const VertexField& field, const View& view,
                  const Placement& placement) {
    const ReferenceRayCaster reference(field, view, placement);
    Agreement agreement;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            const std::optional<RayHit> hit = reference.first_hit(pixel);
            const int px = view.corner.x + x, py = view.corner.y + y;
            const bool covered = picture.covered(px, py);
            agreement.hit += hit || covered;
            agreement.hit_by_one += hit.has_value() != covered;
            if (!hit || !covered)
                continue;
            const double error =
                glm::distance(reference.point(pixel, picture.depth(px, py)), hit->at);
            agreement.depth_errors.push_back(error);
            agreement.elsewhere += error > 0.1;
            const glm::dvec3 normal = picture.normal(px, py);
            const double cosine =
                glm::dot(normal, hit->normal) / (glm::length(normal) * glm::length(hit->normal));
            if (error < 0.01 && std::isfinite(cosine))
                agreement.angles.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)));
        }
    return agreement;
}

View perspective_view(const glm::vec3& eye, const glm::vec3& target) {
    View view;
    view.size = {160, 160};
    const float distance = glm::distance(eye, target);
    view.clip_from_eye =
        glm::perspective(0.9f, 1.0f, std::max(distance - 1.1f, 0.02f), distance + 1.1f);
    view.eye_from_room = glm::lookAt(eye, target, glm::vec3(0, 1, 0));
    return view;
}

} // namespace isochron::render
