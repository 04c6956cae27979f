// Meshes: their pictures, compared with the exact surface, and their upload.
#include "render/drawing/cell_pass.h"

#include "index/scan/scan.h"
#include "index/surface/cell_colors.h"
#include "index/surface/mesh_cases.h"
#include "index/surface/mesh_parts.h"
#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/test_field.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace isochron::render {
namespace {

class MeshPassTest : public GlTest {
  protected:
    static constexpr glm::ivec2 kSize{128, 128};

    /// Balls in a grid, with their planes, meshes and volume.
    index::ExtractionPtr extraction(std::vector<double> isovalues, bool colors = false) {
        auto set = std::make_shared<index::Extraction>();
        set->query = {index::Instant(0), isovalues, index::CellColoring::none};
        std::vector<index::MeshMaker> makers(2);
        index::BlockValues values(index::ValueType::u8, {}, 0, 255);
        index::BlockGatherer gatherer(field_.view().grid, values);
        for (const double isovalue : isovalues) {
            index::CellSet cells;
            cells.query = {index::Instant(0), isovalue};
            index::scan(field_.view(), cells.query, cells.ids);
            EXPECT_TRUE(index::shade_cells(field_.view(), cells));
            index::CellMesh mesh;
            EXPECT_TRUE(make_mesh(makers, field_.view(), cells.query, cells.ids, mesh));
            cells.mesh = std::make_shared<const index::CellMesh>(std::move(mesh));
            gatherer.need(cells);
            set->surfaces.push_back(std::move(cells));
        }
        const index::BlockLevels levels = values.levels(isovalues);
        set->levels = levels.units;
        set->blocks = gatherer.none();
        EXPECT_TRUE(gatherer.gather(field_.view(), index::Instant(0), levels, set->blocks));
        if (colors) // that grow with x
            for (index::CellSet& surface : set->surfaces) {
                auto mesh = std::make_shared<index::CellMesh>(*surface.mesh);
                for (const index::MeshVertex& vertex : mesh->vertices)
                    mesh->colors.push_back(static_cast<std::uint16_t>(index::position_of(vertex).x /
                                                                      30 * index::kFineColorSteps));
                surface.mesh = std::move(mesh);
                for (const index::CellPoint& point : surface.points)
                    set->colors.push_back(
                        static_cast<std::uint16_t>((point.x + 0.5) / 30 * index::kColorSteps));
            }
        set->later->put(index::simplified(set->surfaces, {}));
        return set;
    }

    Image draw(const index::ExtractionPtr& set, Footprint footprint, const CellAppearance& look,
               glm::vec3 eye = {40, 35, 60}) {
        CellBuffers cells(gl_, field_.view().grid);
        while (cells.shown() != set)
            cells.upload(set, std::numeric_limits<std::size_t>::max());
        cells.upload(set, std::numeric_limits<std::size_t>::max());
        EXPECT_TRUE(cells.has_mesh());
        EXPECT_TRUE(cells.has_mesh(3));
        while (cells.compute_corners(part_.value_or(set->cells())) > 0) {
        }
        RenderTarget target(gl_, kSize), other(gl_, kSize);
        target.bind();
        target.clear({0, 0, 0, 1});
        const View view{.clip_from_eye = glm::perspective(angle_, 1.0f, 5.0f, 200.0f),
                        .eye_from_room = glm::lookAt(eye, glm::vec3(15), glm::vec3(0, 1, 0)),
                        .size = kSize};
        const Placement placement = Placement::of(field_.view().grid, glm::mat4(1.0f));
        const std::size_t work = pass_.work(1, cells, footprint, look);
        parts_ = 0;
        for (std::size_t first = 0; first < work; first += part_.value_or(work), ++parts_) {
            if (part_ && parts_ % 3 == 0) { // another picture comes between, of the other side
                View behind = view;
                behind.eye_from_room = glm::lookAt(-eye, glm::vec3(15), glm::vec3(0, 1, 0));
                other.bind();
                pass_.draw(behind, placement, cells, footprint, look);
                target.bind();
            }
            pass_.draw(std::span(&view, 1), placement, cells, footprint, look,
                       {first, part_.value_or(work)});
        }
        return target.read();
    }

    /// Share of pixels with a channel off by more than 8 of 255.
    static double differing(const Image& a, const Image& b) {
        int count = 0;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x) {
                int most = 0;
                for (int channel = 0; channel < 3; ++channel)
                    most = std::max(most, std::abs(a.at(x, y)[channel] - b.at(x, y)[channel]));
                count += most > 8;
            }
        return count / double(kSize.x * kSize.y);
    }

    index::TestField field_{
        {31, 31, 31}, 1, index::ValueType::u8, [](double x, double y, double z, double) {
            return 230 -
                   14 * std::sqrt((x - 15) * (x - 15) + (y - 15) * (y - 15) + (z - 15) * (z - 15));
        }};
    CellPass pass_{gl_};
    float angle_ = 0.6f;              ///< angle of the picture
    std::optional<std::size_t> part_; ///< work of each part that is drawn; empty: all at once
    int parts_ = 0;                   ///< parts of the last picture
};

INSTANTIATE_TEST_SUITE_P(, MeshPassTest, both_contexts(), context_name);

TEST_P(MeshPassTest, LooksLikeTheExactSurface) {
    const auto set = extraction({90.5});
    CellAppearance look;
    EXPECT_LT(differing(draw(set, Footprint::mesh, look), draw(set, Footprint::surface, look)),
              0.01);
}

TEST_P(MeshPassTest, ColorsAreThoseOfTheExactSurface) {
    const auto set = extraction({90.5, 150.5}, true);
    Texture map(gl_, GL_TEXTURE_1D);
    gl_.TextureStorage1D(map.name(), 1, GL_RGBA8, 2);
    constexpr std::array<std::uint8_t, 8> kTexels{255, 0, 0, 255, 0, 0, 255, 255};
    gl_.TextureSubImage1D(map.name(), 0, 0, 2, GL_RGBA, GL_UNSIGNED_BYTE, kTexels.data());
    gl_.TextureParameteri(map.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    CellAppearance look;
    look.values = {.map = map.name()};
    const Image exact = draw(set, Footprint::surface, look);
    for (look.mesh_level = 0; look.mesh_level < 2; ++look.mesh_level)
        EXPECT_LT(differing(draw(set, Footprint::mesh, look), exact),
                  0.02 + 0.04 * look.mesh_level);
    EXPECT_GT(differing(draw(set, Footprint::mesh, {}), exact), 0.1) << "without colors";
}

/// Share of lit pixels of either that are lit in both.
double lit_in_both(const Image& a, const Image& b) {
    double both = 0, any = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        const bool in_a = a.rgba[i] > 8, in_b = b.rgba[i] > 8;
        both += in_a && in_b;
        any += in_a || in_b;
    }
    return both / any;
}

TEST_P(MeshPassTest, SimplifiedMeshesLookLikeTheExactSurfaceFromAllSides) {
    const auto set = extraction({90.5});
    for (const glm::vec3 eye :
         {glm::vec3(40, 35, 60), glm::vec3(-40, 10, 3), glm::vec3(9, -60, 5)}) {
        const Image exact = draw(set, Footprint::surface, {}, eye);
        double before = 1.0;
        for (const std::size_t level : {1, 2, 3}) {
            CellAppearance look;
            look.mesh_level = level;
            const double same = lit_in_both(draw(set, Footprint::mesh, look, eye), exact);
            EXPECT_GT(same, 1 - 0.02 * static_cast<double>(level * level)) << level;
            EXPECT_LT(same, before) << "coarser, and another mesh";
            before = same;
        }
    }
}

TEST_P(MeshPassTest, TranslucentSimplifiedMeshesAreSortedByDistance) {
    const auto set = extraction({90.5, 150.5});
    CellAppearance look;
    look.surfaces[0] = {{0.2f, 0.9f, 0.3f}, 0.4f};
    look.surfaces[1] = {{0.9f, 0.2f, 0.2f}, 0.6f};
    look.linear_light = false;
    for (const glm::vec3 eye : {glm::vec3(40, 35, 60), glm::vec3(-40, 10, 3)}) {
        const Image exact = draw(set, Footprint::surface, look, eye);
        look.mesh_level = 1;
        EXPECT_LT(differing(draw(set, Footprint::mesh, look, eye), exact), 0.05);
    }
    const auto meshes = set->meshes(1);
    const std::array<std::size_t, 2> first{0, meshes[0]->vertices.size()};
    const glm::vec4 ahead(0.3f, -0.5f, 0.8f, 4);
    const auto corners = far_first(meshes, first, ahead);
    ASSERT_EQ(corners.size(), meshes[0]->triangles.size() + meshes[1]->triangles.size());
    float before = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const bool second = corners[i] >= first[1];
        const index::MeshVertex& v = meshes[second]->vertices[corners[i] - first[second]];
        const float distance = glm::dot(glm::vec4(v.x, v.y, v.z, 1), ahead);
        EXPECT_LT(distance, before + 0.01f);
        before = distance;
    }
}

TEST_P(MeshPassTest, InnerSurfacesShowThroughTranslucentOnes) {
    const auto set = extraction({90.5, 150.5});
    CellAppearance look;
    look.surfaces[0] = {{0.2f, 0.9f, 0.3f}, 0.4f};
    look.surfaces[1] = {{0.9f, 0.2f, 0.2f}, 1.0f};
    look.linear_light = false;
    const Image mesh = draw(set, Footprint::mesh, look);
    EXPECT_GT(mesh.at(64, 64)[0], mesh.at(64, 64)[1]) << "the inner one is red";
    EXPECT_LT(differing(mesh, draw(set, Footprint::surface, look)), 0.02);
}

TEST_P(MeshPassTest, WhatIsCutAwayIsThatOfTheExactSurface) {
    const auto set = extraction({90.5});
    CellAppearance look;
    look.cuts = {glm::vec4(1, 0, 0, -16.3f)};
    const Image mesh = draw(set, Footprint::mesh, look);
    EXPECT_GT(differing(mesh, draw(set, Footprint::mesh, {})), 0.02);
    EXPECT_LT(differing(mesh, draw(set, Footprint::surface, look)), 0.01);
}

TEST_P(MeshPassTest, PartsGiveThePictureOfTheWholeToTheBit) {
    const auto set = extraction({90.5, 150.5}, true);
    Texture map(gl_, GL_TEXTURE_1D);
    gl_.TextureStorage1D(map.name(), 1, GL_RGBA8, 2);
    constexpr std::array<std::uint8_t, 8> kTexels{255, 0, 0, 255, 0, 0, 255, 255};
    gl_.TextureSubImage1D(map.name(), 0, 0, 2, GL_RGBA, GL_UNSIGNED_BYTE, kTexels.data());
    for (const bool colored : {false, true})
        for (const float opacity : {1.0f, 0.4f})
            for (const Footprint footprint :
                 {Footprint::quad, Footprint::gaussian, Footprint::mesh, Footprint::surface}) {
                CellAppearance look;
                look.linear_light = opacity < 1.0f;
                look.surfaces[0].opacity = opacity;
                if (colored)
                    look.values = {.map = map.name()};
                look.mesh_level = opacity < 1 && colored ? 1 : 0;
                const Image whole = draw(set, footprint, look);
                part_ = footprint == Footprint::mesh && look.mesh_level > 0 ? 250 : 700;
                EXPECT_EQ(draw(set, footprint, look).rgba, whole.rgba);
                // Without an order, as on a GPU, quads are drawn in one piece.
                if (footprint != Footprint::quad || is_drawn_for_processor(gl_)) {
                    EXPECT_GT(parts_, 2);
                }
                part_.reset();
            }
}

/// Where a voxel is small, ways to the eye and the key light are found at vertices and highlights are
/// approximated; where something is cut away, all is found for each pixel.
TEST_P(MeshPassTest, LightIsThatOfEachPixelFoundInFull) {
    const auto set = extraction({90.5});
    struct Case {
        float shininess, away, angle;
    };
    for (const Case& one : {Case{4, 0.7f, 0.6f}, Case{10, 0.7f, 0.6f}, Case{40, 1.2f, 0.15f},
                            Case{80, 1.2f, 0.15f}, Case{300, 2.0f, 0.08f}}) {
        SCOPED_TRACE(one.shininess);
        CellAppearance look;
        look.shininess = one.shininess;
        look.reflectance = 0.3f;
        angle_ = one.angle;
        const glm::vec3 eye = glm::vec3(15) + one.away * glm::vec3(25, 20, 45);
        const Image fast = draw(set, Footprint::mesh, look, eye);
        look.cuts = {glm::vec4(1, 0, 0, -1000)}; // nothing
        const Image full = draw(set, Footprint::mesh, look, eye);
        int most = 0;
        for (std::size_t i = 0; i < full.rgba.size(); ++i)
            most = std::max(most, std::abs(full.rgba[i] - fast.rgba[i]));
        EXPECT_LE(most, 3) << "of 255";
        EXPECT_NE(full.rgba, fast.rgba) << "both are found in the same way";
    }
}

TEST_P(MeshPassTest, AnyOrderOfPlanesGivesTheSamePicture) {
    const auto set = extraction({90.5, 150.5}, true);
    const index::CellMesh& mesh = *set->surfaces[0].mesh;
    std::vector<CellPlace> cells;
    for (const index::CellPoint& point : set->surfaces[0].points)
        cells.push_back({point.x, point.y, point.z, 0});
    std::vector<std::size_t> cell_of; // cell of each triangle
    for (std::size_t i = 0; i < cells.size(); ++i)
        cell_of.insert(cell_of.end(), index::mesh_cases()[mesh.cases[i]].triangles, i);
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> number_of; // number of a triangle
    for (std::uint32_t i = 0; i < mesh.triangles.size(); i += 3)
        number_of[{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]}] = i / 3;
    ASSERT_EQ(number_of.size(), mesh.triangles.size() / 3);
    for (int axis = 0; axis < 3; ++axis)
        for (const bool descending : {false, true}) {
            std::vector<std::uint32_t> corners{1, 2, 3}; // corners of a surface before
            append_in_order(cells, mesh, {axis, descending}, corners);
            ASSERT_EQ(corners.size(), 3 + mesh.triangles.size());
            std::vector<std::uint32_t> order; // triangles differ in their vertices
            for (std::size_t i = 3; i < corners.size(); i += 3)
                order.push_back(number_of.at({corners[i], corners[i + 1], corners[i + 2]}));
            const auto plane = [&](std::uint32_t triangle) {
                const CellPlace& cell = cells[cell_of[triangle]];
                return axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z;
            };
            for (std::size_t i = 1; i < order.size(); ++i) {
                const int before = plane(order[i - 1]), here = plane(order[i]);
                ASSERT_TRUE(descending ? before >= here : before <= here);
                ASSERT_TRUE(before != here || order[i - 1] < order[i]);
            }
            EXPECT_EQ(std::set(order.begin(), order.end()).size(), order.size());
        }
    // Seen along each axis from either side, the nearer planes come first, and the pictures are
    // those of the exact surface.
    for (const glm::vec3 ahead : {glm::vec3(60, 5, 9), glm::vec3(7, 60, 5), glm::vec3(3, 8, 60)})
        for (const float side : {1.0f, -1.0f}) {
            const glm::vec3 eye = glm::vec3(15) + side * ahead;
            const PlaneOrder order =
                near_planes_first(glm::vec4(eye, 1), glm::vec3(30), glm::vec3(1));
            EXPECT_GT(std::abs(ahead[order.axis]), 50);
            EXPECT_EQ(order.descending, side > 0);
            CellAppearance look;
            EXPECT_LT(differing(draw(set, Footprint::mesh, look, eye),
                                draw(set, Footprint::surface, look, eye)),
                      0.01);
        }
}

TEST_P(MeshPassTest, TranslucentTrianglesAreSortedInPieces) {
    const auto set = extraction({90.5, 150.5});
    CellBuffers cells(gl_, field_.view().grid);
    while (cells.shown() != set)
        cells.upload(set, std::numeric_limits<std::size_t>::max());
    CellAppearance look;
    look.surfaces[0].opacity = look.surfaces[1].opacity = 0.4f;
    RenderTarget target(gl_, kSize);
    target.bind();
    const View view{.clip_from_eye = glm::perspective(0.6f, 1.0f, 5.0f, 200.0f),
                    .eye_from_room =
                        glm::lookAt(glm::vec3(40, 35, 60), glm::vec3(15), glm::vec3(0, 1, 0)),
                    .size = kSize};
    const Placement placement = Placement::of(field_.view().grid, glm::mat4(1.0f));
    const std::size_t work = pass_.work(1, cells, Footprint::mesh, look);
    EXPECT_GT(work, cells.size());
    std::size_t pieces = 0;
    for (std::size_t first = 0; first < work; first += 40) {
        pass_.draw(std::span(&view, 1), placement, cells, Footprint::mesh, look, {first, 40});
        pieces += pass_.orders().sorts() == 0;
    }
    EXPECT_NEAR(static_cast<double>(pieces), static_cast<double>(work - cells.size()) / 40, 1);
    EXPECT_EQ(pass_.orders().sorts(), 1u);
}

TEST_P(MeshPassTest, AMeshComesInPortionsAndIsShownWhole) {
    const auto first = extraction({150.5}), second = extraction({90.5});
    CellBuffers cells(gl_, field_.view().grid);
    while (cells.shown() != first)
        cells.upload(first, 1 << 16);
    const std::size_t indices = cells.mesh().surfaces()[0].indices;
    int frames = 0;
    for (; cells.shown() != second; ++frames) {
        EXPECT_EQ(cells.mesh().surfaces()[0].indices, indices);
        const std::uint64_t before = cells.count().mesh_bytes;
        cells.upload(second, 1 << 16);
        EXPECT_LE(cells.count().mesh_bytes - before, 1u << 16);
        ASSERT_LT(frames, 1000);
    }
    EXPECT_GT(frames, 1);
    EXPECT_EQ(cells.mesh().surfaces()[0].indices, second->surfaces[0].mesh->triangles.size());
}

} // namespace
} // namespace isochron::render
