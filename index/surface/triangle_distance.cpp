// How far a point is from a triangle.
#include "index/surface/triangle_distance.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace isochron::index {
namespace {

double squared_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length = glm::dot(along, along);
    const double share =
        length > 0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
    const glm::dvec3 off = point - (a + share * along);
    return glm::dot(off, off);
}

} // namespace

double squared_distance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = b - a, ac = c - a, normal = glm::cross(ab, ac), to = point - a;
    const double area = glm::dot(normal, normal); // area of the parallelogram, squared
    if (area > 0) {
        const double second = glm::dot(glm::cross(to, ac), normal) / area;
        const double third = glm::dot(glm::cross(ab, to), normal) / area;
        if (second >= 0 && third >= 0 && second + third <= 1) {
            const glm::dvec3 off = to - second * ab - third * ac;
            return glm::dot(off, off);
        }
    }
    return std::min({squared_to_segment(point, a, b), squared_to_segment(point, b, c),
                     squared_to_segment(point, c, a)});
}

} // namespace isochron::index
