// Colors of exact surfaces and meshes, compared with a second array interpolated at each pixel's hit.
#include "index/surface/cell_colors.h"
#include "index/surface/mesh_colors.h"
#include "index/surface/mesh_parts.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "render/passes/color_map.h"
#include "tests/render/cells/extractions.h"
#include "tests/render/cells/reference_ray_caster.h"
#include "tests/render/cells/surface_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace isochron::render {
namespace {

constexpr glm::ivec2 kColoredSize{200, 200};
constexpr double kColoredIsovalue = 0.03, kColoredLow = -1.5, kColoredHigh = 1.5;

class SurfaceColorsTest : public GlTest {
  protected:
    SurfaceColorsTest() : colors_({24, 20, 22}, 1, index::ValueType::f32, waves) {}

    static double waves(double x, double y, double z, double) {
        return std::sin(0.4 * x + 0.3 * z) + 0.5 * std::cos(0.5 * y - 0.2 * x);
    }

    /// As the worker makes it. @param shaded with points and a mesh, for the processor
    index::ExtractionPtr colored(bool shaded) {
        Extractions extractions(volume_.view());
        auto set = extractions.active(0, {kColoredIsovalue});
        if (shaded)
            set = extractions.shaded(set);
        auto made = std::make_shared<index::Extraction>(*set);
        index::CellSet& surface = made->surfaces[0];
        const std::vector<index::CellId>& ids = surface.ids;
        made->colors.resize(ids.size());
        made->corner_colors.resize(8 * ids.size());
        EXPECT_TRUE(index::color_cells(volume_.view(), colors_.view(),
                                       {index::Instant(0), kColoredIsovalue}, ids, kColoredLow,
                                       kColoredHigh, made->colors));
        index::color_corners(colors_.view(), index::Instant(0), ids, kColoredLow, kColoredHigh,
                             made->corner_colors);
        if (!shaded)
            return made;
        std::vector<index::MeshMaker> makers(1);
        index::CellMesh mesh;
        EXPECT_TRUE(
            make_mesh(makers, volume_.view(), {index::Instant(0), kColoredIsovalue}, ids, mesh));
        mesh.values = index::values_at(colors_.view(), index::Instant(0), mesh.vertices, 0);
        index::color_by_values(mesh, kColoredLow, kColoredHigh);
        surface.mesh = std::make_shared<const index::CellMesh>(std::move(mesh));
        return made;
    }

    Image draw(const index::ExtractionPtr& set, Footprint footprint, const View& view) {
        CellBuffers cells(gl_, volume_.view().grid);
        while (cells.shown() != set || cells.wants_volume())
            cells.upload(set, std::numeric_limits<std::size_t>::max());
        return draw(cells, footprint, view);
    }
    Image draw(CellBuffers& cells, Footprint footprint, const View& view) {
        cells.compute_corners();
        const Texture map = color_map_texture(gl_, map_);
        CellAppearance look; // lit evenly from all sides
        look.values = {.map = map.name()};
        look.ambient = look.ground = 1.0f;
        look.head_light = look.key_light = look.reflectance = look.outline = 0.0f;
        look.depth_cue = look.occlusion = 0.0f;
        RenderTarget target(gl_, kColoredSize);
        target.bind();
        target.clear({0, 0, 0, 0});
        pass_.draw(view, placed_at_origin(volume_.view().grid), cells, footprint, look);
        return target.read();
    }

    /// The color of a place, sRGB, 0 to 255.
    glm::dvec3 color_at(const RayHit& hit) const {
        const VertexField field(colors_.view(), {index::Instant(0), 0.0});
        const double value = field.value(hit.cell, hit.at - glm::dvec3(hit.cell));
        const double at =
            std::clamp((value - kColoredLow) / (kColoredHigh - kColoredLow), 0.0, 1.0) *
            static_cast<double>(map_.size() - 1);
        const auto below = std::min(static_cast<std::size_t>(at), map_.size() - 2);
        return 255.0f * srgb_from_linear(glm::mix(map_[below], map_[below + 1],
                                                  static_cast<float>(at - double(below))));
    }

    /// Whether one smooth piece of the surface is seen in all pixels around one: no outline is near.
    static bool is_inside(const ReferenceRayCaster& caster, const RayHit& hit, glm::dvec2 pixel) {
        constexpr double kFar = 1; // cells, where cells are of ten pixels
        for (const glm::dvec2 beside : {glm::dvec2(-2, 0), glm::dvec2(2, 0), glm::dvec2(0, -2),
                                        glm::dvec2(0, 2), glm::dvec2(-2, -2), glm::dvec2(2, 2)}) {
            const auto near = caster.first_hit(pixel + beside);
            if (!near || glm::distance(near->at, hit.at) > kFar)
                return false;
        }
        return true;
    }

    /// Percentage of the pixels with a surface in which a channel is off by more than 8 of 255.
    /// @param inside leave out pixels beside outlines
    double percent_off(const Image& picture, const View& view, bool inside = false) {
        const VertexField field(volume_.view(), {index::Instant(0), kColoredIsovalue});
        const ReferenceRayCaster caster(field, view, placed_at_origin(volume_.view().grid));
        int all = 0, off = 0;
        for (int y = 0; y < kColoredSize.y; ++y)
            for (int x = 0; x < kColoredSize.x; ++x) {
                const auto shown =
                    picture.at(x, kColoredSize.y - 1 - y); // rows of pictures go down
                const auto hit = caster.first_hit({x + 0.5, y + 0.5});
                if (!hit || shown[3] == 0 ||
                    (inside && !is_inside(caster, *hit, {x + 0.5, y + 0.5})))
                    continue;
                const glm::dvec3 wanted = color_at(*hit);
                double most = 0;
                for (int channel = 0; channel < 3; ++channel)
                    most = std::max(most, std::abs(wanted[channel] - shown[channel]));
                ++all;
                off += most > 8;
            }
        EXPECT_GT(all, 5000);
        return 100.0 * off / all;
    }

    static View seen_from(glm::vec3 eye) {
        return {.clip_from_eye = glm::perspective(0.8f, 1.0f, 0.3f, 6.0f),
                .eye_from_room = glm::lookAt(eye, glm::vec3(0), glm::vec3(0, 1, 0)),
                .size = kColoredSize};
    }

    index::TestField volume_{
        {24, 20, 22}, 1, index::ValueType::f32, index::turbulence(random_, 24)};
    index::TestField colors_;
    std::vector<glm::vec3> map_ = color_map(ColorMap::viridis);
    CellPass pass_{gl_};
};

INSTANTIATE_TEST_SUITE_P(, SurfaceColorsTest, both_contexts(), context_name);

TEST_P(SurfaceColorsTest, AreThoseOfTheSecondArrayInterpolatedAtTheHit) {
    for (const glm::vec3 eye : {glm::vec3(1.5f, 1.2f, 1.8f), glm::vec3(-2.2f, 0.3f, 0.8f)}) {
        const View view = seen_from(eye);
        const double exact = percent_off(draw(colored(false), Footprint::surface, view), view);
        const double shaded = percent_off(draw(colored(true), Footprint::surface, view), view);
        const Image triangles = draw(colored(true), Footprint::mesh, view);
        const double mesh = percent_off(triangles, view);
        const double mesh_inside = percent_off(triangles, view, true);
        std::printf("off by more than 8 of 255: %.3f %% of the pixels, %.3f %% in the ways of a "
                    "processor, %.3f %% of the mesh's, %.3f %% of those not beside outlines\n",
                    exact, shaded, mesh, mesh_inside);
        EXPECT_LE(exact, 0.1);
        EXPECT_LE(shaded, 0.1);
        EXPECT_LE(mesh_inside, 1.5);
        EXPECT_LE(mesh, 4.0) << "whose outlines are elsewhere: cells are of ten pixels";
    }
}

TEST_P(SurfaceColorsTest, AVertexWithoutAValueMakesItsCellsGray) {
    const View view = seen_from({1.5f, 1.2f, 1.8f});
    const auto known = colored(false);
    auto made = std::make_shared<index::Extraction>(*known);
    for (std::size_t i = 0; i < made->corner_colors.size(); i += 8)
        made->corner_colors[i + i / 8 % 8] = index::kNoFineColor;
    const Image picture = draw(made, Footprint::surface, view);
    const int gray = int(std::lround(255 * ValueColors{}.no_value.x));
    int lit = 0;
    for (int y = 0; y < kColoredSize.y; ++y)
        for (int x = 0; x < kColoredSize.x; ++x)
            if (const auto at = picture.at(x, y); at[3] > 0) {
                ++lit;
                ASSERT_NEAR(at[0], gray, 1);
                ASSERT_NEAR(at[2], gray, 1);
            }
    EXPECT_GT(lit, 5000);
}

TEST_P(SurfaceColorsTest, FollowTheirCellsToOtherSlots) {
    // Most of the cells first, so that without points the others get slots out of order.
    const auto set = colored(false);
    std::vector<index::CellId> some;
    for (std::size_t i = 0; i < set->surfaces[0].ids.size(); ++i)
        if (i % 8 != 3)
            some.push_back(set->surfaces[0].ids[i]);
    Extractions extractions(volume_.view());
    const auto first = extractions.of_cells(0, {some}, kColoredIsovalue);
    CellBuffers cells(gl_, volume_.view().grid);
    for (const auto& next : {first, set})
        while (cells.shown() != next || cells.wants_volume())
            cells.upload(next, std::size_t{1} << 16);
    bool moved = false;
    for (std::size_t rank = 0; rank < set->cells(); ++rank)
        moved |= cells.slots().slot_of(rank) != rank;
    EXPECT_TRUE(moved);
    const View view = seen_from({1.5f, 1.2f, 1.8f});
    EXPECT_LE(percent_off(draw(cells, Footprint::surface, view), view), 0.1);
}

} // namespace
} // namespace isochron::render
