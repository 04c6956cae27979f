// Cells of mixed levels of detail: placed and sized by their positions, and without holes.
#include "index/detail/detail_regions.h"
#include "index/indexing/index_build.h"
#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/extractions.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace isochron::render {
namespace {

constexpr int kPicture = 160;
constexpr int kParts = index::DetailQuery::kPartsOfLevel;
constexpr std::size_t kRoom = std::size_t{1} << 26;

double ball(double x, double y, double z, double) {
    return 40.0 - std::sqrt((x - 46) * (x - 46) + (y - 50) * (y - 50) + (z - 47) * (z - 47));
}

class MixedLevels : public GlTest {
  protected:
    MixedLevels() : field_({97, 98, 95}, 1, index::ValueType::f32, ball) {
        appearance_.depth_cue = 0.0f;
        appearance_.occlusion = 0.0f;
    }

    /// As it is seen from a place, in index space.
    void look_from(const glm::vec3& eye, bool parallel) {
        view_.size = {kPicture, kPicture};
        view_.clip_from_eye = parallel ? glm::ortho(-60.f, 60.f, -60.f, 60.f, 1.f, 1000.f)
                                       : glm::perspective(0.6f, 1.0f, 1.0f, 1000.0f);
        view_.eye_from_room = glm::lookAt(eye, glm::vec3(46, 50, 47), glm::vec3(0, 1, 0.1f));
        placement_.extent = glm::vec3(96, 97, 94);
    }
    Image picture(const index::ExtractionPtr& set, Footprint footprint, CellShape shape,
                  bool all = false) {
        return picture(set, field_.view().grid, footprint, shape, all);
    }
    Image picture(const index::ExtractionPtr& set, const index::Grid& grid, Footprint footprint,
                  CellShape shape, bool all = false) {
        CellBuffers buffers(gl_, grid);
        while (!buffers.upload(set, kRoom, SendVolume::never))
            ;
        CellPass pass(gl_, {.shape = shape}, prelude_for(grid));
        if (all)
            pass.draw_hidden_cells();
        RenderTarget target(gl_, {kPicture, kPicture});
        target.bind();
        target.clear({0, 0, 0, 0});
        pass.draw(view_, placement_, buffers, footprint, appearance_);
        return target.read();
    }
    std::vector<bool> lit(const Image& image) {
        std::vector<bool> lit;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                lit.push_back(image.at(x, y)[0] + image.at(x, y)[1] + image.at(x, y)[2] > 0);
        return lit;
    }
    static index::Extract extract_of(const index::StepValues& values,
                                     const test_support::TestFolder& folder) {
        index::MemorySeries series(values);
        build_index(series, folder.path() / "a",
                    {.tiers = index::TierSet().with(index::Tier::bricks)});
        return index::extract_from(index::IndexFile::open(folder.path() / "a", 1), std::nullopt,
                                   index::Shading::cells);
    }
    /// Pixels that one picture lights, and two do, one of them, or the other.
    struct Areas {
        int first = 0, missed = 0, extra = 0;
    };
    static Areas compare(const std::vector<bool>& first, const std::vector<bool>& second) {
        Areas areas;
        for (std::size_t p = 0; p < first.size(); ++p) {
            areas.first += first[p];
            areas.missed += first[p] && !second[p];
            areas.extra += second[p] && !first[p];
        }
        return areas;
    }
    /// The whole set with positions as mixed sets have them.
    static index::ExtractionPtr doubled(const index::ExtractionPtr& set) {
        auto made = std::make_shared<index::Extraction>(*set);
        made->detail = {0};
        for (index::CellSet& surface : made->surfaces)
            for (index::CellPoint& point : surface.points)
                for (std::uint16_t* at : {&point.x, &point.y, &point.z})
                    *at = static_cast<std::uint16_t>(index::doubled_center(*at, 0));
        return made;
    }

    index::TestField field_;
    View view_;
    Placement placement_;
    CellAppearance appearance_;
};

TEST_P(MixedLevels, AtLevelZeroThePictureIsThatOfTheVolume) {
    Extractions extractions(field_.view());
    const index::ExtractionPtr whole = extractions.shaded(extractions.active(0, {0.0, 20.0}));
    look_from({150, 120, 190}, false);
    for (const CellShape shape : {CellShape::plane, CellShape::voxel})
        for (const Footprint footprint : {Footprint::quad, Footprint::gaussian}) {
            const Image a = picture(whole, footprint, shape);
            const Image b = picture(doubled(whole), footprint, shape);
            EXPECT_TRUE(a.rgba == b.rgba) << name_of(footprint) << name_of(shape);
        }
}

TEST_P(MixedLevels, AClosedSurfaceKeepsItsOutlineAndHasNoHolesInIt) {
    test_support::TestFolder folder;
    const index::Extract extract = extract_of(field_.view(), folder);
    const index::ExtractionPtr whole = extract({index::Instant(0), {0.0}}, {});
    const index::DetailRegions regions(field_.view().grid);
    for (const auto& [eye, parallel] :
         {std::pair{glm::vec3(150, 120, 190), false}, {glm::vec3(80, 200, 100), true}}) {
        look_from(eye, parallel);
        const std::vector<bool> exact = lit(picture(whole, Footprint::quad, CellShape::plane));
        for (int i = 0; i < 2; ++i) {
            index::SurfacesQuery query{index::Instant(0), {0.0}};
            query.detail.most_cells = whole->cells() / 2;
            for (std::size_t r = 0; r < regions.size(); ++r)
                query.detail.wished.push_back(
                    static_cast<std::int8_t>(kParts * int(random_() % 3)));
            const index::ExtractionPtr mixed = extract(query, {});
            ASSERT_TRUE(mixed->coarse());
            const Image seen = picture(mixed, Footprint::quad, CellShape::plane);
            EXPECT_TRUE(seen.rgba == picture(mixed, Footprint::quad, CellShape::plane, true).rgba)
                << "culling changes the picture";
            const std::vector<bool> coarse = lit(seen);
            const Areas areas = compare(exact, coarse);
            EXPECT_GT(areas.first, 3000);
            EXPECT_LE(areas.missed, areas.first / 50);
            EXPECT_LE(areas.extra, areas.first / 10);
            // A hole would be inside of the silhouette.
            for (int y = 2; y + 2 < kPicture; ++y)
                for (int x = 2; x + 2 < kPicture; ++x) {
                    bool inside = true;
                    for (int dy = -2; dy <= 2; ++dy)
                        for (int dx = -2; dx <= 2; ++dx)
                            inside = inside &&
                                     exact[std::size_t(y + dy) * kPicture + std::size_t(x + dx)];
                    if (inside) {
                        EXPECT_TRUE(coarse[std::size_t(y) * kPicture + std::size_t(x)])
                            << x << " " << y;
                    }
                }
        }
    }
}

/// A sheet with a steep step just behind the border of two regions: the coarse level's step is much
/// less steep, so the two sheets are some voxels apart at the border. Seen along the border's
/// normal there is nothing behind a gap between them.
TEST_P(MixedLevels, CellsThatReachIntoFinerRegionsCloseTheGapBetweenTheSheets) {
    const index::TestField sheet({97, 98, 95}, 1, index::ValueType::f32,
                                 [](double x, double, double z, double) {
                                     return 47.0 + 16.0 * std::tanh((x - 30.5) / 1.5) - z;
                                 });
    test_support::TestFolder folder;
    const index::Extract extract = extract_of(sheet.view(), folder);
    index::SurfacesQuery query{index::Instant(0), {0.0}};
    const index::ExtractionPtr whole = extract(query, {});
    const index::DetailRegions regions(sheet.view().grid);
    query.detail.most_cells = whole->cells() - 1;
    for (std::size_t r = 0; r < regions.size(); ++r)
        query.detail.wished.push_back(regions.at(r)[0] == 0 ? 3 * kParts : 0);
    const index::ExtractionPtr mixed = extract(query, {});
    ASSERT_TRUE(mixed->coarse());
    for (std::size_t r = 0; r < regions.size(); ++r)
        ASSERT_EQ(mixed->detail[r] * kParts, query.detail.wished[r]);
    look_from({-200, 50, 47}, true);
    view_.eye_from_room =
        glm::lookAt(glm::vec3(-200, 50, 47), glm::vec3(46, 50, 47), glm::vec3(0, 0, 1));
    /// Rows of the step's face, without its ends, in which rays pass.
    const auto dark_rows = [&](const index::ExtractionPtr& set) {
        const auto seen = lit(picture(set, Footprint::quad, CellShape::plane));
        int dark = 0;
        for (int y = 0; y < kPicture; ++y) {
            const double z = 47 + 120.0 * (y + 0.5 - kPicture / 2.0) / kPicture;
            if (z < 35 || z > 59)
                continue;
            int passing = 0;
            for (int x = kPicture / 4; x < 3 * kPicture / 4; ++x)
                passing += !seen[std::size_t(y) * kPicture + std::size_t(x)];
            dark += passing > 0;
        }
        return dark;
    };
    // Without those that reach into the finer region:
    auto cut = std::make_shared<index::Extraction>(*mixed);
    std::erase_if(cut->surfaces[0].points, [](const index::CellPoint& point) {
        return index::level_of_center(point.x) == 3 && point.x > 64;
    });
    ASSERT_LT(cut->cells(), mixed->cells());
    EXPECT_LE(dark_rows(mixed), 1) << "3/4 of a voxel";
    EXPECT_GE(dark_rows(cut), 4);
}

TEST_P(MixedLevels, OnStretchedAxesASurfaceKeepsItsPlaceAndItsOutline) {
    index::StepValues values = field_.view();
    values.grid = {.vertices = {97, 98, 95}};
    std::vector<double> x{0.0}, z{0.0};
    while (x.size() < 97) // gaps from 0.4 to 1.6 and back
        x.push_back(x.back() + 1.0 - 0.6 * std::cos(double(x.size()) / 96 * 2 * 3.14159265));
    while (z.size() < 95)
        z.push_back(z.back() + (z.size() < 40 ? 0.8 : 1.2));
    values.grid.spacing.x = x.back() / 96;
    values.grid.spacing.z = z.back() / 94;
    values.grid.positions[0] = index::AxisPositions(std::move(x));
    values.grid.positions[2] = index::AxisPositions(std::move(z));
    const index::TestField stretched({97, 98, 95}, 1, index::ValueType::f32,
                                     [&](double a, double b, double c, double) {
                                         const glm::dvec3 p = values.grid.physical({a, b, c});
                                         return ball(p.x, p.y, p.z, 0);
                                     });
    values.first = stretched.view().first;
    test_support::TestFolder folder;
    const index::Extract extract = extract_of(values, folder);
    index::SurfacesQuery query{index::Instant(0), {0.0}};
    const index::ExtractionPtr whole = extract(query, {});
    const index::DetailRegions regions(values.grid);
    query.detail.most_cells = whole->cells() / 2;
    for (std::size_t r = 0; r < regions.size(); ++r)
        query.detail.wished.push_back(static_cast<std::int8_t>(kParts * int(r % 3)));
    const index::ExtractionPtr mixed = extract(query, {});
    ASSERT_TRUE(mixed->coarse());
    ASSERT_GT(std::ranges::max(mixed->detail), std::ranges::min(mixed->detail));
    look_from({150, 120, 190}, false);
    placement_ = Placement::of(values.grid, glm::dmat4(1.0));
    const auto exact = lit(picture(whole, values.grid, Footprint::quad, CellShape::plane));
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian}) {
        const Areas areas =
            compare(exact, lit(picture(mixed, values.grid, footprint, CellShape::plane)));
        EXPECT_GT(areas.first, 3000);
        EXPECT_LE(areas.missed, areas.first / 50) << name_of(footprint);
        EXPECT_TRUE(picture(mixed, values.grid, Footprint::quad, CellShape::plane).rgba ==
                    picture(mixed, values.grid, Footprint::quad, CellShape::plane, true).rgba)
            << "culling changes the picture";
        if (footprint == Footprint::quad) {
            EXPECT_LE(areas.extra, areas.first / 10);
        }
    }
}

/// Where a level gives way to the next one, a voxel of the coarser one is at most 1.2 pixels (with
/// the hysteresis of app/quality/detail_chooser.cpp): no outline moves by more than a pixel, though
/// the coarser level has flatter bumps.
TEST_P(MixedLevels, WhereALevelGivesWayNoOutlineMovesByMoreThanAPixel) {
    const index::TestField bumpy(
        {97, 98, 95}, 1, index::ValueType::f32, [](double x, double y, double z, double) {
            return ball(x, y, z, 0) +
                   2.5 * std::sin(x / 2.5) * std::sin(y / 2.5) * std::sin(z / 2.5);
        });
    test_support::TestFolder folder;
    const index::Extract extract = extract_of(bumpy.view(), folder);
    const index::DetailRegions regions(bumpy.view().grid);
    const index::ExtractionPtr whole = extract({index::Instant(0), {0.0}}, {});
    const auto of_level = [&](unsigned level) {
        index::SurfacesQuery query{index::Instant(0), {0.0}};
        query.detail.most_cells = whole->cells() / 2;
        query.detail.wished.assign(regions.size(), static_cast<std::int8_t>(kParts * int(level)));
        index::ExtractionPtr set = level == 0 ? whole : extract(query, {});
        EXPECT_TRUE(std::ranges::all_of(set->detail, [&](auto of) { return of == level; }));
        return set;
    };
    /// Pixels that are lit, around which none is in the other picture, or the other way round.
    const auto moved = [](const std::vector<bool>& a, const std::vector<bool>& b) {
        int count = 0;
        for (int y = 1; y + 1 < kPicture; ++y)
            for (int x = 1; x + 1 < kPicture; ++x) {
                bool same = false;
                const auto at = [&](int dx, int dy) {
                    return std::size_t(y + dy) * kPicture + std::size_t(x + dx);
                };
                for (int i = 0; i < 9; ++i)
                    same |= b[at(i % 3 - 1, i / 3 - 1)] == a[at(0, 0)];
                count += !same;
            }
        return count;
    };
    for (const unsigned level : {1u, 2u}) {
        const index::ExtractionPtr coarse = of_level(level), fine = of_level(level - 1);
        const auto moved_at = [&](float pixels_of_voxel) {
            look_from({150, 120, 190}, true);
            const float half = 0.5f * kPicture * std::exp2(float(level)) / pixels_of_voxel;
            const float middle = half < 40.0f ? 40.0f : 0.0f; // at the ball's outline
            view_.clip_from_eye =
                glm::ortho(middle - half, middle + half, -half, half, 1.f, 1000.f);
            const auto a = lit(picture(coarse, Footprint::quad, CellShape::plane));
            const auto b = lit(picture(fine, Footprint::quad, CellShape::plane));
            return moved(a, b) + moved(b, a);
        };
        EXPECT_EQ(moved_at(1.2f), 0) << "level " << level;
        EXPECT_GT(moved_at(20.0f), 5) << "it would be seen";
    }
}

/// Cells of up to five levels and large ones that stand for what levels lose.
TEST_P(MixedLevels, CellsThatOthersOfOtherLevelsHideMayBeLeftOut) {
    const index::TestField rough({97, 98, 95}, 1, index::ValueType::f32,
                                 index::scaled(index::turbulence(random_), 100, 0));
    test_support::TestFolder folder;
    const index::Extract extract = extract_of(rough.view(), folder);
    const index::DetailRegions regions(rough.view().grid);
    int several = 0;
    for (int i = 0; i < 3; ++i) {
        index::SurfacesQuery query{index::Instant(0), {0.0, 20.0}};
        query.detail.most_cells = 30'000u >> 2 * i;
        for (std::size_t r = 0; r < regions.size(); ++r)
            query.detail.wished.push_back(
                static_cast<std::int8_t>(int(random_() % 4) * kParts + int(random_() % kParts)));
        const index::ExtractionPtr mixed = extract(query, {});
        ASSERT_TRUE(mixed->coarse());
        several += std::ranges::max(mixed->detail) > std::ranges::min(mixed->detail);
        look_from(i % 2 == 0 ? glm::vec3(150, 120, 190) : glm::vec3(60, 55, 100), false);
        for (const CellShape shape : {CellShape::plane, CellShape::voxel}) {
            EXPECT_TRUE(picture(mixed, Footprint::quad, shape).rgba ==
                        picture(mixed, Footprint::quad, shape, true).rgba)
                << name_of(shape) << " " << i;
            const Image seen = picture(mixed, Footprint::gaussian, shape);
            const Image all = picture(mixed, Footprint::gaussian, shape, true);
            int largest = 0;
            for (std::size_t p = 0; p < seen.rgba.size(); ++p)
                largest = std::max(largest, std::abs(int(seen.rgba[p]) - int(all.rgba[p])));
            EXPECT_LE(largest, 2) << name_of(shape) << " " << i;
        }
    }
    EXPECT_GT(several, 1);
}

INSTANTIATE_TEST_SUITE_P(Contexts, MixedLevels, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
