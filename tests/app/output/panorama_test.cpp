// In a panorama every direction is where it belongs, for both eyes.
#include "tests/support/session_fixture.h"

#include "app/output/panorama.h"
#include "index/indexing/index_build.h"
#include "stereo/image_file.h"
#include "stereo/screen.h"
#include "tests/support/child_process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace isochron::app {
namespace {

constexpr double kPi = std::numbers::pi;

/// Column and row of a direction in an eye's picture of W x W / 2 pixels.
glm::dvec2 place_of(double azimuth, double elevation, int width) {
    return {(azimuth / (2 * kPi) + 0.5) * width - 0.5, (0.5 - elevation / kPi) * width / 2 - 0.5};
}

/// Where an eye that stands on the circle of the eyes sees a point: to the left eye it lies where the
/// line that touches the circle on the left of its direction goes through it.
glm::dvec2 place_of(const glm::dvec3& from_head, double eye, int width) {
    const double away = std::hypot(from_head.x, from_head.z);
    const double azimuth = std::atan2(from_head.x, -from_head.z) - std::asin(eye / away);
    const double elevation = std::atan2(from_head.y, std::sqrt(away * away - eye * eye));
    return place_of(azimuth, elevation, width);
}

TEST(PanoramaPlan, IsASquareOfAnEvenNumberOfPixels) {
    for (const glm::ivec2 size : {glm::ivec2(512, 256), {511, 511}, {254, 254}, {0, 0}})
        EXPECT_THROW(PanoramaPlan{size}, std::invalid_argument) << size.x << ' ' << size.y;
    EXPECT_NO_THROW(PanoramaPlan{glm::ivec2(256)});
}

/// The flat views, as displays draw them, show a far point where the sheet looks for it.
TEST(PanoramaPlan, LooksForEachDirectionWhereTheViewsHaveIt) {
    for (const int width : {256, 600, 4096}) {
        const PanoramaPlan plan{glm::ivec2(width)};
        stereo::Installation installation;
        plan.prepare(installation);
        ASSERT_EQ(installation.windows.size(), 1u);
        const auto& viewports = installation.windows[0].viewports;
        ASSERT_EQ(viewports.size(), 2u);
        int next = 0;
        for (std::size_t sector = 0; sector < plan.sectors(); ++sector) {
            const auto [first, end] = plan.columns(sector);
            EXPECT_EQ(first, next);
            next = end;
            const interaction::Pose head =
                *plan.turned({}, installation.viewers[0], sector).devices[0].pose;
            for (const int column : {first, (first + end) / 2, end - 1})
                for (const int row : {0, 1, width / 8, width / 4 - 1, width / 4, width / 2 - 1}) {
                    const double azimuth = ((column + 0.5) / width - 0.5) * 2 * kPi;
                    const double elevation = (0.5 - (row + 0.5) / (width / 2.0)) * kPi;
                    const bool upper = row < width / 4;
                    const render::View view =
                        stereo::view_of(viewports[upper ? 0 : 1].screen, head, stereo::Eye::center,
                                        {}, 0.05f, 5000.0f, {100, 100});
                    const glm::dvec3 way(std::cos(elevation) * std::sin(azimuth),
                                         std::sin(elevation),
                                         -std::cos(elevation) * std::cos(azimuth));
                    const glm::dvec4 clip =
                        glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room) *
                        glm::dvec4(glm::dvec3(head.position) + 1000.0 * way, 1.0);
                    ASSERT_GT(clip.w, 0);
                    const glm::dvec2 at = plan.place_in_view(azimuth, elevation, sector, upper);
                    EXPECT_NEAR(at.x, 0.5 + 0.5 * clip.x / clip.w, 1e-3);
                    EXPECT_NEAR(at.y, 0.5 + 0.5 * clip.y / clip.w, 1e-3);
                    for (const double share : {at.x, at.y}) {
                        EXPECT_GT(share, 0.0);
                        EXPECT_LT(share, 1.0);
                    }
                }
        }
        EXPECT_EQ(next, width);
    }
}

/// A small sphere somewhere in an otherwise empty volume: 1 at its center, falling by 1 a vertex.
class SmallSphere final : public index::VolumeSeries {
  public:
    static constexpr int kEdge = 33;
    explicit SmallSphere(glm::ivec3 center) : center_(center) {
        info_.array = std::string("distance");
        info_.grid.vertices = {kEdge, kEdge, kEdge};
        info_.times = {0};
        info_.sources = {"made in memory"};
    }
    const index::SeriesInfo& info() const override { return info_; }
    void read(std::size_t, std::span<std::byte> out) override {
        std::size_t at = 0;
        for (int z = 0; z < kEdge; ++z)
            for (int y = 0; y < kEdge; ++y)
                for (int x = 0; x < kEdge; ++x, at += sizeof(float)) {
                    const auto value = static_cast<float>(
                        1 - glm::length(glm::dvec3(x, y, z) - glm::dvec3(center_)));
                    std::memcpy(out.data() + at, &value, sizeof value);
                }
    }

  private:
    glm::ivec3 center_;
    index::SeriesInfo info_;
};

/// Middle of what is bright in the rows of one eye.
glm::dvec2 middle_of_bright(const render::Image& image, int first_row) {
    glm::dvec2 sum(0.0);
    double weight = 0;
    for (int row = 0; row < image.height / 2; ++row)
        for (int column = 0; column < image.width; ++column) {
            constexpr int kDark = 60;
            const int light = image.at(column, first_row + row)[1];
            if (light < kDark)
                continue;
            // Shading makes one side darker: every pixel of the sphere counts alike, its rim less.
            const double one = std::min(1.0, (light - kDark) / 30.0);
            sum += one * glm::dvec2(column, row);
            weight += one;
        }
    return weight > 0 ? sum / weight : glm::dvec2(-1);
}

/// The data's cube of 1.5 m stands around the place given by height and distance.
TEST(Panorama, ShowsASphereWhereEachEyeSeesIt) {
    const TestFolder folder;
    constexpr int kWidth = 1024;
    constexpr double kSize = 1.5, kHeight = 2.2, kDistance = 1.4, kHead = 1.6, kEye = 0.0315;
    const std::string config =
        fmt::format("[rendering]\ncontext = \"egl\"\nbounding_box = false\nbackground = [0, 0, 0]\n"
                    "[lighting]\nambient = 1.0\nhead_light = 0.0\nkey_light = 0.0\nreflectance = 0.0\n"
        "outline = 0.0\ndepth_cue = 0.0\n"
                    "[[surfaces]]\nisovalue = 0.0\ncolor = [1, 1, 1]\n"
                    "[viewer]\nposition = [0, {}, 0]\neye_separation = {}\n"
                    "[placement]\nsize = {}\nheight = {}\ndistance = {}\n",
                    kHead, 2 * kEye, kSize, kHeight, kDistance);
    std::ofstream(folder.path() / "c.toml") << config;
    for (const glm::ivec3 center : {glm::ivec3(4, 28, 16), {29, 3, 30}, {16, 30, 2}}) {
        SmallSphere series(center);
        index::build_index(series, folder.path() / "s.isochron", {});
        const ChildResult made =
            run_child(test_support::binary_root() + "/isochron",
                      {"movie", "s.isochron", "--panorama", "--config", "c.toml", "--size",
                       std::to_string(kWidth), std::to_string(kWidth), "--rate", "0.1", "-o", "p/",
                       "--force"},
                      folder.path());
        ASSERT_EQ(made.status, 0) << made.err;
        const render::Image image = stereo::read_image(folder.path() / "p/frame_00000.png");
        ASSERT_EQ(image.width, kWidth);
        ASSERT_EQ(image.height, kWidth);
        const double vertex = kSize / (SmallSphere::kEdge - 1);
        const glm::dvec3 from_head(vertex * (center.x - 16),
                                   kHeight + vertex * (center.y - 16) - kHead,
                                   -kDistance + vertex * (center.z - 16));
        for (const bool right : {false, true}) {
            const glm::dvec2 seen = middle_of_bright(image, right ? kWidth / 2 : 0);
            const glm::dvec2 expected = place_of(from_head, right ? kEye : -kEye, kWidth);
            EXPECT_NEAR(seen.x, expected.x, 0.5) << center.x << (right ? " right" : " left");
            EXPECT_NEAR(seen.y, expected.y, 0.5) << center.x << (right ? " right" : " left");
        }
    }
}

} // namespace
} // namespace isochron::app
