// Volumes in which cells hide others.
#pragma once

#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace isochron::render {

struct Volume {
    View view;
    Placement placement;
    std::vector<glm::ivec3> cells;
};

/// A shell with grains around it, in a random view, sometimes a parallel one. Half of the scenes
/// are whole, seen from outside, with cubic voxels; others may be seen from inside, cut by the
/// view's edges, and have uneven voxels.
inline Volume random_volume(std::mt19937& random) {
    auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Volume volume;
    const bool whole = random() % 2;
    const double cells = std::floor(uniform(2, 24));
    glm::dvec3 voxel(1.0 / cells);
    if (random() % 2)
        voxel.x = -voxel.x;
    if (!whole)
        voxel[int(random() % 3)] *= uniform(1, 4);
    volume.view.size = {int(uniform(40, 300)), int(uniform(40, 300))};
    volume.view.corner = {int(uniform(0, 30)), int(uniform(0, 30))};
    volume.placement.extent = glm::vec3(float(cells));
    const glm::dvec3 axis(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1));
    const double distance = whole ? uniform(2.5, 6.0) : uniform(0.0, 3.0);
    const glm::dvec2 aside = whole ? glm::dvec2(0) : glm::dvec2(uniform(-1, 1), uniform(-1, 1));
    volume.placement.room_from_index =
        glm::mat4(glm::translate(glm::dmat4(1.0), glm::dvec3(aside, -distance)) *
                  glm::rotate(glm::dmat4(1.0), random() % 5 ? uniform(0, 6) : 0.0, axis) *
                  glm::scale(glm::dmat4(1.0), voxel) *
                  glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5 * cells)));
    const double slope = uniform(1.1, 1.5) / std::max(distance, 1.0);
    const double aspect = volume.view.size.x / double(volume.view.size.y);
    const double up = slope * std::max(1.0, 1.0 / aspect), side = up * aspect;
    constexpr double kNear = 0.1;
    volume.view.clip_from_eye =
        random() % 4
            ? glm::mat4(
                  glm::frustum(-side * kNear, side * kNear, -up * kNear, up * kNear, kNear, 12.0))
            : glm::mat4(glm::ortho(-side * distance - 0.1, side * distance + 0.1,
                                   -up * distance - 0.1, up * distance + 0.1, kNear, 12.0));
    const int last = int(cells) - 1;
    for (int z = 0; z <= last; ++z)
        for (int y = 0; y <= last; ++y)
            for (int x = 0; x <= last; ++x) {
                const double r = glm::length(glm::dvec3(x, y, z) + 0.5 - 0.5 * cells);
                if (std::abs(r - 0.4 * cells) < 0.7 || random() % 20 == 0)
                    volume.cells.push_back({x, y, z});
            }
    std::shuffle(volume.cells.begin(), volume.cells.end(), random);
    return volume;
}

/// A closed shell seen from outside, and its cells back to front.
struct Shell {
    Shell() {
        constexpr int kCells = 40;
        volume.view.size = {500, 400};
        volume.view.clip_from_eye = glm::perspective(0.6f, 1.25f, 0.5f, 10.0f);
        volume.placement.extent = glm::vec3(kCells);
        volume.placement.room_from_index =
            glm::scale(glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -3)), 0.5f,
                                   glm::vec3(0.3f, 1.0f, 0.2f)),
                       glm::vec3(1.0f / kCells)) *
            glm::translate(glm::mat4(1.0f), glm::vec3(-0.5f * kCells));
        for (std::uint16_t z = 0; z < kCells; ++z)
            for (std::uint16_t y = 0; y < kCells; ++y)
                for (std::uint16_t x = 0; x < kCells; ++x)
                    if (const glm::vec3 at = glm::vec3(x, y, z) - 19.5f;
                        std::abs(glm::length(at) - 16.0f) < 0.9f) {
                        slots.places.push_back({x, y, z, 0});
                        slots.planes.push_back(
                            packed_normal(glm::normalize(at),
                                          std::clamp(16.0 - double(glm::length(at)), -0.8, 0.8)));
                    }
        slots.slot_of_rank.resize(slots.places.size());
        std::iota(slots.slot_of_rank.begin(), slots.slot_of_rank.end(), 0u);
        const glm::vec4 eye = glm::inverse(volume.placement.room_from_index)[3];
        order_back_to_front(slots, traversal_key(eye, glm::ivec3(kCells), glm::vec3(1.0f)), order);
    }
    Volume volume;
    Slots slots;
    std::vector<std::uint32_t> order;
};

/// Pictures with and without hidden cells.
class HiddenCellsTest : public GlTest {
  protected:
    /// All cells look different.
    CellBuffers shown(const Volume& volume) { return showing(gl_, points_of(volume)); }
    std::vector<index::CellPoint> points_of(const Volume& volume) {
        std::vector<index::CellPoint> points;
        for (const glm::ivec3& cell : volume.cells) {
            const glm::vec3 normal(float(random_() % 100) - 50, float(random_() % 100) - 50, 20);
            // Few planes pass through the cell's middle, and some cells have no plane.
            const double offset = (double(random_() % 1000) - 500) / 600;
            points.push_back({std::uint16_t(cell.x), std::uint16_t(cell.y), std::uint16_t(cell.z),
                              std::uint16_t(random_() % 3),
                              random_() % 20 ? packed_normal(glm::normalize(normal), offset) : 0});
        }
        return points;
    }
    Image draw(CellPass& pass, const Volume& volume, const CellBuffers& cells,
               const CellAppearance& look, Footprint footprint, int samples = 1) {
        RenderTarget target(gl_, volume.view.corner + volume.view.size, samples);
        target.bind();
        target.clear({0, 0, 0, 0});
        pass.draw(volume.view, volume.placement, cells, footprint, look);
        target.resolve();
        return target.read();
    }
    CellAppearance three_colors() {
        CellAppearance look;
        look.surfaces[0].color = {1, 0.3f, 0.2f};
        look.surfaces[1].color = {0.2f, 1, 0.3f};
        look.surfaces[2].color = {0.3f, 0.2f, 1};
        return look;
    }
    /// Calls it for both shapes, with one pass that culls hidden cells and one that draws all.
    template <class Test>
    void with_both_shapes(Test&& test) {
        for (const CellShape shape : {CellShape::plane, CellShape::voxel}) {
            SCOPED_TRACE(name_of(shape));
            CellPass seen(gl_, {.shape = shape}), all(gl_, {.shape = shape});
            all.draw_hidden_cells();
            test(shape, seen, all);
        }
    }
};

} // namespace isochron::render
