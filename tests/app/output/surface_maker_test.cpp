// Surfaces that a session exports: in the background, under names that are free, and no part of a file.
#include "app/loop/surface_maker.h"
#include "app/output/export_request.h"
#include "index/surface/cell_colors.h"
#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using interaction::ExportWork;
using testing::ElementsAre;
using testing::HasSubstr;

class SurfaceMakerTest : public testing::Test {
  protected:
    SurfaceMakerTest() {
        state_.isosurfaces = {{8.0, {1, 0, 0}, 1}, {4.0, {0, 0, 1}, 0.5f}};
        state_.exporting = {true, 0};
    }
    /// Frames until the export has ended. @return what is said of it
    std::string outcome() {
        std::vector<std::string> lines;
        EXPECT_TRUE(test_support::eventually([&] {
            if (const auto work = maker_.update(state_)) {
                state_.exporting = *work;
                told_.push_back(*work);
            }
            const auto more = maker_.messages();
            lines.insert(lines.end(), more.begin(), more.end());
            return !lines.empty() && !state_.exporting.goes_on;
        }));
        maker_.update(state_);
        EXPECT_EQ(lines.size(), 1u);
        return lines.empty() ? std::string() : lines.front();
    }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        if (!fs::exists(folder_.path() / "out"))
            return names;
        for (const auto& entry : fs::directory_iterator(folder_.path() / "out"))
            names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }

    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_ = build_sphere(folder_.path());
    SurfaceMaker maker_{file_, folder_.path() / "out"};
    ExplorerState state_;
    std::vector<ExportWork> told_;
};

TEST_F(SurfaceMakerTest, WhatIsShownIsWrittenUnderAFreeName) {
    fs::create_directory(folder_.path() / "out");
    folder_.write("out/isochron_surface_0001.ply", "someone else's");
    state_.instant = index::Instant(2);
    EXPECT_THAT(outcome(), HasSubstr("isochron_surface_0002.ply: "));
    EXPECT_EQ(told_.back(), ExportWork{}) << "the panel is told that it has ended";
    EXPECT_THAT(files(), ElementsAre("isochron_surface_0001.ply", "isochron_surface_0002.ply"));
    EXPECT_EQ(folder_.read("out/isochron_surface_0001.ply"), "someone else's");
    EXPECT_THAT(folder_.read("out/isochron_surface_0002.ply"), HasSubstr("step 2, time 1 s"));
}

TEST_F(SurfaceMakerTest, ARangeHasAFileForEachOfItsSteps) {
    state_.pictures.surfaces = {"vtp", interaction::ExportedSteps::range, true};
    state_.play_range = {1, 3};
    outcome();
    EXPECT_THAT(files(),
                ElementsAre("isochron_surface_0001.pvd", "isochron_surface_0001_0001.vtp",
                            "isochron_surface_0001_0002.vtp", "isochron_surface_0001_0003.vtp"));
}

TEST_F(SurfaceMakerTest, WhatIsCanceledLeavesNoPartOfAFile) {
    state_.pictures.surfaces = {"ply", interaction::ExportedSteps::range, true};
    maker_.update(state_);
    state_.exporting = {};
    EXPECT_EQ(maker_.update(state_), std::nullopt) << "the user knows";
    maker_.finish();
    for (const std::string& name : files())
        EXPECT_THAT(folder_.read("out/" + name), HasSubstr("end_header")) << name;
}

TEST_F(SurfaceMakerTest, AFolderThatCannotBeIsOneLine) {
    folder_.write("plain", "a file");
    state_.pictures.folder = (folder_.path() / "plain/sub").string();
    EXPECT_THAT(outcome(), HasSubstr("plain"));
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
}

TEST_F(SurfaceMakerTest, TheClipPlaneCutsAsItIsShown) {
    state_.clip = {true, {12, 15.5, 15.5}, {1, 0, 0}};
    const index::ExportRequest cut = shown_request(state_, file_);
    ASSERT_TRUE(cut.reshape);
    EXPECT_EQ(cut.surfaces[1].opacity, 0.5f);
    EXPECT_EQ(cut.surfaces[1].color, (std::array<std::uint8_t, 3>{0, 0, 255}));
    state_.pictures.surfaces.clipped = false;
    EXPECT_FALSE(shown_request(state_, file_).reshape);
}

TEST_F(SurfaceMakerTest, TranslucentSurfacesAreTranslucentInFormatsThatHaveOpacity) {
    for (const auto& [format, said] :
         {std::pair("usda", "float[] primvars:displayOpacity = [0.5] ("), {"glb", "\"BLEND\""}}) {
        state_.pictures.surfaces = {format, interaction::ExportedSteps::shown, true};
        outcome();
        const std::string file = folder_.read(std::string("out/isochron_surface_0001.") + format);
        const std::size_t at = file.find(said);
        EXPECT_NE(at, std::string::npos) << format;
        EXPECT_EQ(file.find(said, at + 1), std::string::npos) << "the other one is opaque";
        state_.exporting = {true, 0};
    }
}

TEST_F(SurfaceMakerTest, ColorsHaveTheRangeOfThePicture) {
    state_.coloring.by = interaction::ColorBy::value;
    state_.coloring.percentiles = {5, 95};
    ColorScale scale;
    scale.range = {5, 7};
    const auto color_of = shown_request(state_, file_, scale).values->color_of;
    EXPECT_EQ(color_of(4), color_of(5));
    EXPECT_NE(color_of(5), color_of(6));
    EXPECT_NE(color_of(6), color_of(7));
    EXPECT_EQ(color_of(7), color_of(8));

    int asked = 0;
    const auto scale_of_picture = [&] {
        ++asked;
        return std::optional(scale);
    };
    maker_.update(state_, scale_of_picture);
    maker_.update(state_, scale_of_picture);
    EXPECT_EQ(asked, 1) << "the range does not move while files are written";
}

/// What a PLY file says of its vertices, in their order.
struct PlyColors {
    std::vector<float> values;
    std::vector<std::array<std::uint8_t, 3>> colors;
};

PlyColors ply_colors(const std::string& ply) {
    const std::string end = "end_header\n";
    std::size_t vertices = 0;
    EXPECT_EQ(
        std::sscanf(ply.c_str() + ply.find("element vertex"), "element vertex %zu", &vertices), 1);
    PlyColors found;
    constexpr std::size_t kPlace = 12, kNormal = 12, kValue = 4, kSurface = 1;
    const char* at = ply.c_str() + ply.find(end) + end.size();
    for (std::size_t i = 0; i < vertices; ++i) {
        at += kPlace + kNormal;
        auto& color = found.colors.emplace_back();
        std::memcpy(color.data(), at, color.size());
        at += color.size();
        std::memcpy(&found.values.emplace_back(), at, kValue);
        at += kValue + kSurface;
    }
    return found;
}

TEST_F(SurfaceMakerTest, VerticesHaveTheTimeOfFirstCrossing) {
    state_.coloring.by = interaction::ColorBy::first_crossing;
    state_.isosurfaces.resize(1);
    state_.instant = index::Instant(2);
    EXPECT_THAT(outcome(), HasSubstr("isochron_surface_0001.ply: "));
    const PlyColors ply = ply_colors(folder_.read("out/isochron_surface_0001.ply"));
    const std::set<float> values(ply.values.begin(), ply.values.end());
    const std::set<std::array<std::uint8_t, 3>> colors(ply.colors.begin(), ply.colors.end());
    const auto& times = file_->info().times;
    for (const float value : values)
        EXPECT_TRUE(std::ranges::any_of(times, [&](double time) {
            return time <= times[2] && std::abs(time - value) < 1e-3;
        })) << value;
    EXPECT_EQ(colors.size(), values.size()) << "a color for each time";
    EXPECT_GT(*values.rbegin(), times[1] + 1e-3) << "some cells are new";
    EXPECT_GT(values.size(), 1u) << "others are not";
}

TEST_F(SurfaceMakerTest, BetweenStepsFirstCrossingsAreThoseOfThePicture) {
    state_.coloring.by = interaction::ColorBy::first_crossing;
    state_.between = interaction::BetweenSteps::blend;
    state_.isosurfaces.resize(1);
    const auto& times = file_->info().times;
    int number = 0;
    for (const std::uint32_t fraction : {0u, 20'000u}) { // a step shows crossings of blends, too
        state_.instant = {2, fraction};
        state_.exporting = {true, 0};
        outcome();
        const PlyColors ply =
            ply_colors(folder_.read(fmt::format("out/isochron_surface_{:04}.ply", ++number)));

        index::SurfacesQuery shown = state_.surfaces();
        EXPECT_EQ(shown.instant, index::Instant(2, fraction));
        shown.mesh_room = std::uint64_t{1} << 30;
        const index::ExtractionPtr picture =
            index::extract_from(file_, std::nullopt, index::Shading::cells)(shown, {});
        const index::CellMesh& mesh = *picture->surfaces.front().mesh;
        PercentileRange none;
        const ColorScale scale = *color_scale(state_, *file_, {picture}, none);
        const auto map = colors_of(scale);
        ASSERT_EQ(ply.values.size(), mesh.vertices.size());
        ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
        std::size_t between = 0;
        for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
            const double time = std::lerp(times.front(), times.back(),
                                          mesh.colors[i] / double{index::kFineColorSteps});
            ASSERT_NEAR(ply.values[i], time, 1e-6) << i;
            ASSERT_EQ(ply.colors[i], color_at(map, share_on(scale, ply.values[i]))) << i;
            if (std::ranges::none_of(times, [&](double of) { return std::abs(of - time) < 1e-3; }))
                ++between;
        }
        EXPECT_GT(between, 20u) << "vertices whose time is that of no step";
    }
}

} // namespace
} // namespace isochron::app
