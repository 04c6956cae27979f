// Cells of mixed levels of detail: placed and sized by their positions, and without holes.
#include "index/build/index_build.h"
#include "index/extraction/detail_regions.h"
#include "render/cells/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/render/cells/extractions.h"
#include "tests/support/gl_test.h"
#include "tests/support/memory_series.h"
#include "tests/support/test_folder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cstring>
#include <vector>

namespace isochron::render {
namespace {

constexpr int kPicture = 160;
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
        CellBuffers buffers(gl_, field_.view().grid);
        while (!buffers.upload(set, kRoom, SendVolume::never))
            ;
        CellPass pass(gl_, {.shape = shape});
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

TEST_P(MixedLevels, NoRayPassesThroughAClosedSurfaceBetweenLevels) {
    test_support::TestFolder folder;
    index::MemorySeries series(field_.view());
    build_index(series, folder.path() / "a", {});
    const auto file = index::IndexFile::open(folder.path() / "a", 1);
    const index::Extract extract = index::extract_from(file, std::nullopt, index::Shading::cells);
    const index::ExtractionPtr whole = extract({0, {0.0}}, {});
    const index::DetailRegions regions(file->info().grid);
    for (const auto& [eye, parallel] : {std::pair{glm::vec3(150, 120, 190), false},
                                        {glm::vec3(80, 200, 100), true}}) {
        look_from(eye, parallel);
        const std::vector<bool> exact = lit(picture(whole, Footprint::quad, CellShape::plane));
        for (int i = 0; i < 2; ++i) {
            index::SurfacesQuery query{0, {0.0}};
            query.detail.most_cells = whole->cells() / 2;
            for (std::size_t r = 0; r < regions.size(); ++r)
                query.detail.wished.push_back(static_cast<std::int8_t>(random_() % 3));
            const index::ExtractionPtr mixed = extract(query, {});
            ASSERT_TRUE(mixed->coarse());
            const Image seen = picture(mixed, Footprint::quad, CellShape::plane);
            EXPECT_TRUE(seen.rgba ==
                        picture(mixed, Footprint::quad, CellShape::plane, true).rgba)
                << "culling changes the picture";
            const std::vector<bool> coarse = lit(seen);
            int area = 0, missed = 0, extra = 0;
            for (std::size_t p = 0; p < exact.size(); ++p) {
                area += exact[p];
                missed += exact[p] && !coarse[p];
                extra += coarse[p] && !exact[p];
            }
            EXPECT_GT(area, 3000);
            EXPECT_LE(missed, area / 50);
            EXPECT_LE(extra, area / 10);
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

INSTANTIATE_TEST_SUITE_P(Contexts, MixedLevels, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
