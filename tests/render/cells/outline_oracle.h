// The outline of a cell's ellipsoid on the screen, by the paper's construction.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace isochron::render {

/// An ellipse in pixels from the middle of the viewport, y up.
struct Ellipse {
    glm::dvec2 center;
    glm::dvec2 major, minor; ///< half axes

    /// 1 on the outline, less inside; linear along rays from the center.
    double distance(const glm::dvec2& at) const {
        const glm::dvec2 d = at - center;
        return std::hypot(glm::dot(d, major) / glm::dot(major, major),
                          glm::dot(d, minor) / glm::dot(minor, minor));
    }
};

/// Vrolijk, Botha and Post 2004, section 5: the quadric of the voxel sphere goes to projection
/// space, Q' = M^-T Q M^-1, and is seen there along z, by a camera that is infinitely far off: with
/// Q' = [A b; b^T c], where c belongs to z, the outline is the conic C = c A - b b^T. Its
/// eigenvectors are the axes. Written in double and with inverses, as far from the shader's dual
/// form as the same ellipse allows.
/// @param pixel_from_index clip space, x and y scaled to pixels
/// @param quadric of an ellipsoid: d . quadric d = 1 for the way d from its center to its surface
inline Ellipse paper_ellipse(const glm::dmat4& pixel_from_index, const glm::dvec3& center,
                             const glm::dmat3& quadric) {
    const glm::dvec3 moved = quadric * center;
    glm::dmat4 q(quadric);
    q[3] = glm::dvec4(-moved, glm::dot(center, moved) - 1.0);
    for (int i = 0; i < 3; ++i)
        q[i][3] = -moved[i];
    const glm::dmat4 inverse = glm::inverse(pixel_from_index);
    const glm::dmat4 p = glm::transpose(inverse) * q * inverse;
    constexpr int kSeen[3] = {0, 1, 3}; // x, y, w
    glm::dmat3 c;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c[i][j] = p[2][2] * p[kSeen[i]][kSeen[j]] - p[2][kSeen[i]] * p[2][kSeen[j]];

    const glm::dmat2 a(c[0][0], c[0][1], c[1][0], c[1][1]);
    const glm::dvec2 middle = -glm::inverse(a) * glm::dvec2(c[2][0], c[2][1]);
    const double level = -(c[2][2] + glm::dot(glm::dvec2(c[2][0], c[2][1]), middle));
    const double mean = 0.5 * (a[0][0] + a[1][1]);
    const double t = std::hypot(0.5 * (a[0][0] - a[1][1]), a[0][1]);
    const double angle = 0.5 * std::atan2(2.0 * a[0][1], a[0][0] - a[1][1]);
    const glm::dvec2 u(std::cos(angle), std::sin(angle)); // eigenvector of mean + t
    const double along = std::sqrt(level / (mean + t)), across = std::sqrt(level / (mean - t));
    Ellipse ellipse{middle, u * along, glm::dvec2(-u.y, u.x) * across};
    if (along < across)
        std::swap(ellipse.major, ellipse.minor);
    return ellipse;
}

inline Ellipse paper_ellipse(const glm::dmat4& pixel_from_index, const glm::dvec3& center,
                             double radius) {
    return paper_ellipse(pixel_from_index, center, glm::dmat3(1.0 / (radius * radius)));
}

} // namespace isochron::render
