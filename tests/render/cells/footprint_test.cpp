// The pixels that a single cell covers, compared with the paper's conic and with rays.
#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/outline_oracle.h"
#include "tests/render/cells/random_views.h"
#include "tests/support/drawing/gl_test.h"

#include <algorithm>
#include <functional>

namespace isochron::render {
namespace {

constexpr double kQuadRadius = 0.5 * double(FootprintShapes{}.quad_diameter);

/// Pixels where the picture disagrees with `inside` (pixels from the middle, y up), though the
/// whole square of one pixel around them says the same.
int wrong_pixels(const Image& image, int threshold,
                 const std::function<bool(const glm::dvec2&)>& inside) {
    int wrong = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec2 at(x + 0.5 - 0.5 * image.width, 0.5 * image.height - y - 0.5);
            const bool covered = image.at(x, y)[3] > threshold;
            bool explained = false;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    explained = explained || inside(at + glm::dvec2(dx, dy)) == covered;
            wrong += !explained;
        }
    return wrong;
}

class FootprintGeometry : public GlTest {
  protected:
    /// Alpha tells what is covered: the target is cleared to nothing.
    Image draw(const Scene& scene, Footprint footprint, FootprintShapes shapes,
               std::uint32_t plane = 0) {
        if (plane == 0)
            shapes.shape = CellShape::voxel;
        CellPass pass(gl_, shapes);
        RenderTarget target(gl_, scene.view.size);
        const CellBuffers cells = showing(gl_, cell_set({scene.cell}, plane));
        target.bind();
        target.clear({0, 0, 0, 0});
        pass.draw(scene.view, scene.placement, cells, footprint);
        return target.read();
    }
};

TEST_P(FootprintGeometry, ACellCoversTheProjectionOfItsEllipsoidWithinAPixel) {
    for (int round = 0; round < tries(120); ++round) {
        const Scene scene = random_scene(random_);
        const Ellipse ellipse =
            paper_ellipse(scene.pixel_from_index(), glm::dvec3(scene.cell) + 0.5, scene.radius);
        if (scene.eye_distance() < 1.2 * scene.radius)
            continue; // faded away
        const Image image =
            draw(scene, Footprint::gaussian, {.gaussian_diameter = 4.0f, .gaussian_sigma = 1e6f});
        EXPECT_EQ(wrong_pixels(image, 0,
                               [&](const glm::dvec2& at) { return ellipse.distance(at) < 1.0; }),
                  0)
            << "round " << round;
    }
}

/// The ellipsoid that stands for a plane, step by step and in double.
struct PlaneEllipsoid {
    PlaneEllipsoid(const Scene& scene, std::uint32_t word, double radius) {
        const index::CellPlane plane = index::unpack_plane(word);
        const glm::dmat3 room_from_index(scene.placement.room_from_index); // physical is room
        n = glm::normalize(glm::transpose(room_from_index) * plane.normal);
        const glm::dvec3 size = glm::abs(n);
        const double rest =
            std::max(0.5 * (size.x + size.y + size.z) - std::abs(plane.offset), 0.007);
        std::array<int, 3> by_size{0, 1, 2};
        std::ranges::sort(by_size, {}, [&](int i) { return size[i]; });
        const double length = 1.3 * rest / size[by_size[0]], width = rest / size[by_size[1]];

        glm::dvec3 corner, edge(0.0);
        for (int i = 0; i < 3; ++i) {
            corner[i] = std::copysign(0.5, n[i] * plane.offset);
            corner[i] -= std::copysign(std::min(rest / (3.0 * size[i]), 0.5), corner[i]);
        }
        edge[by_size[0]] = 1.0;
        center = glm::dvec3(scene.cell) + 0.5 + corner + (plane.offset - glm::dot(n, corner)) * n;
        const glm::dvec3 lengthwise = glm::normalize(edge - glm::dot(edge, n) * n);
        for (const auto& [axis, half] : {std::pair(n, 0.125),
                                         {lengthwise, std::clamp(length, 0.15, 1.0)},
                                         {glm::cross(n, lengthwise), std::clamp(width, 0.15, 1.0)}})
            quadric += glm::outerProduct(axis, axis) / (radius * radius * half * half);
    }
    glm::dvec3 center, n;
    glm::dmat3 quadric{0.0};
};

std::uint32_t random_plane(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    return packed_normal(glm::normalize(glm::dvec3(any(random), any(random), any(random))),
                         index::CellPlane::kFarthest * any(random));
}

TEST_P(FootprintGeometry, ACellOnAPlaneCoversTheProjectionOfItsEllipsoidWithinAPixel) {
    const FootprintShapes shapes{.plane_gaussian_radius = 2.0f, .plane_sigma = 1e6f};
    int covered = 0;
    for (int round = 0; round < tries(150); ++round) {
        const Scene scene = random_scene(random_, {200, 160}, 3.0);
        const std::uint32_t plane = random_plane(random_);
        const PlaneEllipsoid ellipsoid(scene, plane, 2.0);
        const Ellipse ellipse =
            paper_ellipse(scene.pixel_from_index(), ellipsoid.center, ellipsoid.quadric);
        if (scene.eye_distance() < 4.0)
            continue; // too near for an outline in the picture's plane
        const Image image = draw(scene, Footprint::gaussian, shapes, plane);
        for (std::size_t i = 3; i < image.rgba.size(); i += 4)
            covered += image.rgba[i] > 0;
        EXPECT_EQ(wrong_pixels(image, 0,
                               [&](const glm::dvec2& at) { return ellipse.distance(at) < 1.0; }),
                  0)
            << "round " << round;
    }
    EXPECT_GT(covered, tries(4000));
}

/// Whether a ray meets the plane in the cell, a little enlarged.
class CutCell {
  public:
    CutCell(const Scene& scene, std::uint32_t plane)
        : ellipsoid_(scene, plane, 1.0), middle_(glm::dvec3(scene.cell) + 0.5) {}

    /// @param eye, way in index space; only what is ahead counts
    bool is_met(const glm::dvec3& eye, const glm::dvec3& way) const {
        const double t =
            glm::dot(ellipsoid_.n, ellipsoid_.center - eye) / glm::dot(ellipsoid_.n, way);
        const glm::dvec3 place = glm::abs(eye + t * way - middle_);
        return t > 0.0 && glm::all(glm::lessThan(place, glm::dvec3(kHalf)));
    }
    /// Planes that are seen nearly edge-on are turned.
    bool is_edge_on(const glm::dvec3& way) const {
        return std::abs(glm::dot(ellipsoid_.n, glm::normalize(way))) < 0.05;
    }
    const glm::dvec3& center() const { return ellipsoid_.center; }
    bool holds(const glm::dvec3& at) const {
        return glm::all(glm::lessThan(glm::abs(at - middle_), glm::dvec3(kHalf)));
    }

  private:
    static constexpr double kHalf = double{FootprintShapes{}.half_cell};
    PlaneEllipsoid ellipsoid_;
    glm::dvec3 middle_;
};

TEST_P(FootprintGeometry, AQuadOnAPlaneShowsWhatOfThePlaneLiesInTheCell) {
    int met = 0;
    for (int round = 0; round < tries(150); ++round) {
        const Scene scene = random_scene(random_, {200, 160}, 1.0);
        const std::uint32_t plane = random_plane(random_);
        const CutCell cell(scene, plane);
        if (scene.eye_distance() < 8.0)
            continue; // so near that the place in the cell is not linear in the picture
        const glm::dmat4 pixel_from_index = scene.pixel_from_index();
        const glm::dmat4 index_from_pixel = glm::inverse(pixel_from_index);
        const auto unprojected = [&](const glm::dvec2& at, double z) {
            const glm::dvec4 p = index_from_pixel * glm::dvec4(at, z, 1.0);
            return glm::dvec3(p) / p.w;
        };
        const auto way = [&](const glm::dvec2& at) {
            return unprojected(at, 0.5) - unprojected(at, -1.0);
        };
        const glm::dvec4 middle = pixel_from_index * glm::dvec4(cell.center(), 1.0);
        if (cell.is_edge_on(way(glm::dvec2(middle) / middle.w)))
            continue;
        const Image image = draw(scene, Footprint::quad, {}, plane);
        for (std::size_t i = 3; i < image.rgba.size(); i += 4)
            met += image.rgba[i] > 127;
        EXPECT_EQ(wrong_pixels(image, 127,
                               [&](const glm::dvec2& at) {
                                   return cell.is_met(unprojected(at, -1.0), way(at));
                               }),
                  0)
            << "round " << round;
    }
    EXPECT_GT(met, tries(400));
}

/// A cell about two voxels beside the eye, in a wide frustum.
Scene beside_the_eye(std::mt19937& random) {
    Scene scene;
    scene.view.size = {160, 160};
    scene.view.clip_from_eye = glm::perspective(glm::radians(120.0f), 1.0f, 0.001f, 10.0f);
    std::uniform_real_distribution<double> any(-1, 1);
    const glm::dvec3 spacing(0.10, 0.12, 0.15);
    const glm::dvec3 at(0.25 + 0.1 * any(random), 0.05, -0.1 + 0.05 * any(random));
    scene.placement.room_from_index =
        glm::mat4(glm::scale(glm::translate(glm::dmat4(1.0), at), spacing) *
                  glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5)));
    return scene;
}

/// The ray of a pixel of that view, in eye space.
glm::dvec4 ray_beside(const glm::dvec2& pixel) {
    return {pixel * (std::tan(glm::radians(60.0)) / 80.0), -1.0, 0.0};
}

TEST_P(FootprintGeometry, AQuadOnAPlaneBesideTheEyeIsCutAtTheEyesPlane) {
    int met = 0;
    for (int round = 0; round < tries(60); ++round) {
        const Scene scene = beside_the_eye(random_);
        const std::uint32_t plane = random_plane(random_);
        const CutCell cell(scene, plane);
        const glm::dmat4 index_from_eye = glm::inverse(glm::dmat4(scene.placement.room_from_index));
        const glm::dvec3 eye(index_from_eye[3]);
        if (cell.holds(eye) || cell.is_edge_on(cell.center() - eye))
            continue;
        const Image image = draw(scene, Footprint::quad, {}, plane);
        const auto hit = [&](const glm::dvec2& pixel) {
            return cell.is_met(eye, glm::dvec3(index_from_eye * ray_beside(pixel)));
        };
        met += hit({79.5, 0.5});
        EXPECT_EQ(wrong_pixels(image, 127, hit), 0) << "round " << round;
    }
    EXPECT_GT(met, tries(3));
}

TEST_P(FootprintGeometry, AnEllipsoidBesideTheEyeIsCutAtTheEyesPlane) {
    // Rays from an eye whose plane crosses the ellipsoid, against the ellipsoid itself.
    int cut = 0;
    for (int round = 0; round < tries(60); ++round) {
        const Scene scene = beside_the_eye(random_);
        const std::uint32_t plane = random_plane(random_);
        const PlaneEllipsoid ellipsoid(scene, plane, 2.0);
        const glm::dmat4 index_from_eye = glm::inverse(glm::dmat4(scene.placement.room_from_index));
        const glm::dvec3 from = glm::dvec3(index_from_eye[3]) - ellipsoid.center;
        const double inside = glm::dot(from, ellipsoid.quadric * from);
        if (inside < 1.1 || glm::length(from) < 2.3)
            continue; // faded away
        const Image image = draw(scene, Footprint::gaussian,
                                 {.plane_gaussian_radius = 2.0f, .plane_sigma = 1e6f}, plane);
        const auto hit = [&](const glm::dvec2& pixel) {
            const glm::dvec3 ray(index_from_eye * ray_beside(pixel));
            const double a = glm::dot(ray, ellipsoid.quadric * ray);
            const double b = glm::dot(from, ellipsoid.quadric * ray);
            return b < 0.0 && b * b >= a * (inside - 1.0);
        };
        cut += hit({79.5, 0.5});
        EXPECT_EQ(wrong_pixels(image, 0, hit), 0) << "round " << round;
    }
    EXPECT_GT(cut, tries(3));
}

TEST_P(FootprintGeometry, AGaussianHasItsHalfOpacityOnTheEllipseThatBelongsToIt) {
    for (int round = 0; round < tries(80); ++round) {
        const Scene scene = random_scene(random_);
        if (scene.eye_distance() < 2.0 * scene.radius)
            continue; // faded: opacity is another there
        const Ellipse ellipse =
            paper_ellipse(scene.pixel_from_index(), glm::dvec3(scene.cell) + 0.5, scene.radius);
        const double level = 0.7 * std::sqrt(2.0 * std::log(2.0)) / 2.0;
        const Image image = draw(scene, Footprint::gaussian, {});
        EXPECT_EQ(wrong_pixels(image, 127,
                               [&](const glm::dvec2& at) { return ellipse.distance(at) < level; }),
                  0)
            << "round " << round;
    }
}

TEST_P(FootprintGeometry, AQuadIsTheRectangleOnTheEllipsesAxes) {
    int elongated = 0;
    for (int round = 0; round < tries(150); ++round) {
        const Scene scene = random_scene(random_, {200, 160}, kQuadRadius);
        const Ellipse ellipse =
            paper_ellipse(scene.pixel_from_index(), glm::dvec3(scene.cell) + 0.5, scene.radius);
        const double major = glm::length(ellipse.major), minor = glm::length(ellipse.minor);
        glm::dvec2 u = ellipse.major / major, v = ellipse.minor / minor;
        const double uneven = (major * major - minor * minor) / (major * major + minor * minor);
        if (uneven < 1e-3) {
            u = {1, 0};
            v = {0, 1};
        } else if (uneven > 0.3) {
            ++elongated;
        } else {
            continue; // turning from one to the other
        }
        const Image image = draw(scene, Footprint::quad, {});
        EXPECT_EQ(wrong_pixels(image, 127,
                               [&](const glm::dvec2& at) {
                                   const glm::dvec2 d = at - ellipse.center;
                                   return std::abs(glm::dot(d, u)) < major &&
                                          std::abs(glm::dot(d, v)) < minor;
                               }),
                  0)
            << "round " << round;
    }
    EXPECT_GT(elongated, tries(20));
}

TEST_P(FootprintGeometry, AQuadOfARoundOutlineStandsUpright) {
    Scene scene;
    scene.view.size = {101, 101};
    scene.view.clip_from_eye = glm::ortho(-1.0f, 1.0f, -1.0f, 1.0f, 0.1f, 10.0f);
    scene.placement.room_from_index =
        glm::scale(glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -3)), 0.7f,
                               glm::vec3(0.3f, 0.2f, 0.9f)),
                   glm::vec3(0.5f)) *
        glm::translate(glm::mat4(1.0f), glm::vec3(-0.5f));
    const Image image = draw(scene, Footprint::quad, {});
    const double half = kQuadRadius * 0.5 * 50.5;
    EXPECT_EQ(wrong_pixels(image, 127,
                           [&](const glm::dvec2& at) {
                               return std::abs(at.x) < half && std::abs(at.y) < half;
                           }),
              0);
}

TEST_P(FootprintGeometry, ACellBesideTheEyeIsCutAtTheEyesPlane) {
    // A wide frustum whose plane the ellipsoid crosses: rays against the silhouette's circle.
    Scene scene;
    scene.view.size = {160, 160};
    scene.view.clip_from_eye = glm::perspective(glm::radians(120.0f), 1.0f, 0.001f, 10.0f);
    const glm::dvec3 spacing(0.10, 0.12, 0.15);
    const glm::dvec3 center(0.35, 0.05, -0.1);
    scene.placement.room_from_index =
        glm::mat4(glm::scale(glm::translate(glm::dmat4(1.0), center), spacing) *
                  glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5)));
    const Image image = draw(scene, Footprint::gaussian, {.gaussian_sigma = 1e6f});
    // The fade near the eye lowers the opacity of the whole footprint.
    const glm::dvec3 to_eye = -center / spacing / 2.0; // eye, in radii from the center
    const double distance = glm::length(to_eye);
    ASSERT_GT(distance, 1.0);
    const double along = 1.0 / (distance * distance);
    int peak = 0;
    for (int i = 3; i < 160 * 160 * 4; i += 4)
        peak = std::max<int>(peak, image.rgba[i]);
    ASSERT_GT(peak, 20);
    EXPECT_EQ(wrong_pixels(image, peak / 2,
                           [&](const glm::dvec2& at) {
                               const double slope = std::tan(glm::radians(60.0)) / 80.0;
                               const glm::dvec3 ray = glm::dvec3(at * slope, -1.0) / spacing / 2.0;
                               // Hits the circle's plane where dot(p, to_eye) = 1.
                               const double t = (1.0 - distance * distance) / glm::dot(ray, to_eye);
                               const glm::dvec3 p = to_eye + t * ray - along * to_eye;
                               return t > 0.0 && glm::dot(p, p) < 1.0 - along;
                           }),
              0);
}

TEST_P(FootprintGeometry, ACellAroundTheEyeIsNotDrawn) {
    Scene scene;
    scene.view.size = {64, 64};
    scene.view.clip_from_eye = glm::perspective(1.0f, 1.0f, 0.01f, 10.0f);
    for (const float offset : {-0.5f, -0.45f, -0.9f}) {
        scene.placement.room_from_index = glm::translate(glm::mat4(1.0f), glm::vec3(offset));
        for (const Footprint footprint : {Footprint::quad, Footprint::gaussian})
            for (const std::uint8_t value : draw(scene, footprint, {}).rgba)
                ASSERT_EQ(value, 0);
    }
}

TEST_P(FootprintGeometry, ACellBehindTheEyeIsNotDrawn) {
    Scene scene;
    scene.view.size = {64, 64};
    scene.view.clip_from_eye = glm::perspective(1.0f, 1.0f, 0.01f, 10.0f);
    for (const float distance : {1.0f, 2.5f, 5.0f}) {
        scene.placement.room_from_index =
            glm::translate(glm::mat4(1.0f), glm::vec3(-0.5f, -0.5f, distance));
        for (const Footprint footprint : {Footprint::quad, Footprint::gaussian})
            for (const std::uint8_t value : draw(scene, footprint, {}).rgba)
                ASSERT_EQ(value, 0) << distance;
    }
}

INSTANTIATE_TEST_SUITE_P(, FootprintGeometry, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
