// The view in a link: what is written is read again, the page's camera sees what the native picture shows, and what is
// no setting changes nothing.
#include "app/explore/link_view.h"

#include "app/config/first_placement.h"
#include "app/explore/link_tools.h"
#include "index/system/links/link.h"
#include "interaction/tools/clip_box.h"
#include "stereo/screen.h"
#include "tests/support/indexed.h"
#include "tests/support/test_seed.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <regex>

namespace isochron::app {
namespace {

const LinkScreen kScreen{{.lower_left = {-0.8f, 0.8f, -1},
                          .upper_left = {-0.8f, 1.7f, -1},
                          .upper_right = {0.8f, 1.7f, -1}},
                         {{0, 1.25f, 0.2f}, {1, 0, 0, 0}},
                         {1600, 900}};

class LinkView : public testing::Test {
  protected:
    test_support::TestFolder folder_;
    index::TestField field_{
        {19, 17, 15}, 2, index::ValueType::f32, [](double x, double y, double z, double t) {
            return std::sin(x) + y - z + t;
        }};
    std::shared_ptr<const index::IndexFile> opened_ = [this] {
        index::StepValues values = field_.view();
        values.grid.origin = {100, -20, 3};
        return index::indexed(folder_, values);
    }();
    const index::IndexFile& file_ = *opened_;

    /// What is read of a link that was written.
    ExplorerState reread(const std::string& link) {
        const std::string address = index::address_of(link);
        return as_linked({}, index::settings_of_link(address), file_, kScreen);
    }
};

TEST_F(LinkView, IsReadAsItWasWritten) {
    ExplorerState state;
    state.isosurfaces = {{1.25, {1, 0.2f, 0}, 1}, {-3, {0, 0, 1}, 0.5f}};
    state.picked = 1;
    state.instant = index::Instant(1);
    state.clip = {true, {101, -19.5, 4}, {0, 0.6, -0.8}};
    state.ghosts = {.earlier = 1, .later = 4, .every = 3, .opacity = 0.5f};
    state.clip_box = {true, {0, 2.5, 1}, {18, 16, 13.25}};
    state.coloring = {.by = interaction::ColorBy::value, .map = "turbo", .range = {{-1, 2.5}}};
    state.coloring.array = file_.info().array;
    state.slices = {.planes = {{{103, -12, 6.5}, {0.6, 0, 0.8}}, {{1, 2, 3}, {1, 0, 0}, false}}};
    state.slices.coloring.map = "turbo";
    state.slices.coloring.range = {{-2, 1}};
    state.slices.coloring.array = file_.info().array;
    state.slices.isolines = false;
    state.slices.alone = true;
    // The data lie on their side, and no camera whose up is their z sees them so.
    state.room_from_physical.rotation =
        glm::angleAxis(2.0, glm::normalize(glm::dvec3(0.3, 0.5, -1)));
    const std::string link = link_to("http://h/a.isochron", state, file_, kScreen);
    const ExplorerState read = reread(link);
    ASSERT_EQ(read.isosurfaces.size(), 2u);
    EXPECT_EQ(read.isosurfaces[0].isovalue, 1.25);
    EXPECT_EQ(read.isosurfaces[1].isovalue, -3);
    EXPECT_FLOAT_EQ(read.isosurfaces[1].opacity, 0.5f);
    EXPECT_NEAR(read.isosurfaces[0].color.y, 0.2, 0.002);
    EXPECT_EQ(read.picked, 1u);
    EXPECT_EQ(read.instant.step, 1u);
    EXPECT_EQ(read.clip.point, state.clip.point);
    EXPECT_NEAR(glm::distance(read.clip.normal, state.clip.normal), 0, 1e-9);
    EXPECT_EQ(read.clip_box, state.clip_box);
    EXPECT_EQ(read.ghosts, state.ghosts);
    EXPECT_EQ(read.coloring.map, "turbo");
    EXPECT_EQ(read.coloring.range, state.coloring.range);
    state.slices.planes.pop_back(); // a link holds what is seen
    EXPECT_EQ(read.slices, state.slices);
    EXPECT_GT(
        std::abs(glm::dot(read.room_from_physical.rotation, state.room_from_physical.rotation)),
        1 - 1e-9);
    // What is up follows from the view, which the link says with seven digits.
    const auto but_up = [](const std::string& text) {
        return std::regex_replace(text, std::regex("&up=[^&]*"), "");
    };
    EXPECT_EQ(but_up(link_to("http://h/a.isochron", read, file_, kScreen)), but_up(link));
    EXPECT_NE(but_up(link), link);
}

TEST_F(LinkView, CutsAsThePageAndEarlierVersionsWroteIt) {
    const interaction::ClipPlane oblique{true, {1, 2, 3}, {0, 0.6, 0.8}};
    EXPECT_EQ(reread("http://h/c.isochron#planes=1/2/3/0/0.6/0.8").clip, oblique);
    EXPECT_EQ(reread("http://h/d.isochron#plane=1,2,3,0,0.6,0.8").clip, oblique);
    EXPECT_EQ(reread("http://h/e.isochron#clip=1,0.5").clip,
              (interaction::ClipPlane{true, {100, -12, 3}, {0, 1, 0}}));
    // What lies beside the data is nothing that a box may end at.
    EXPECT_EQ(reread("http://h/f.isochron#box=-4,2.5,1,99,16,13.25").clip_box,
              (interaction::ClipBox{true, {0, 2.5, 1}, {18, 16, 13.25}}));
}

TEST_F(LinkView, CutsByThePlanesOfAPageAsFarAsTheyAreOnePlaneAndABox) {
    const auto is_cut = [&](const ExplorerState& state, const glm::dvec3& at) {
        return std::ranges::any_of(cutting_planes(state, data_frame(file_.info())),
                                   [&](const auto& plane) { return plane.beyond(at) > 0; });
    };
    const ExplorerState state =
        reread("http://h/g.isochron#planes=104/0/0/-1/0/0,108/-12/10/0/0.6/0.8,0/-8.5/0/0/1/0,"
               "115/0/0/1/0/0,117/0/0/1/0/0&box=0,0,2,18,16,14");
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<double> x(100, 118), y(-20, -4), z(3, 17);
    int cut = 0;
    constexpr int kPoints = 2000;
    for (int i = 0; i < kPoints; ++i) {
        const glm::dvec3 at(x(random), y(random), z(random));
        const bool wanted = at.x < 104 || at.y > -8.5 || at.x > 115 || at.z < 5 ||
                            0.6 * (at.y + 12) + 0.8 * (at.z - 10) > 0;
        EXPECT_EQ(is_cut(state, at), wanted) << at.x << ' ' << at.y << ' ' << at.z;
        cut += wanted;
    }
    EXPECT_EQ(lost_of_link({{"planes", "1/2/3/1/0/0,1/2/3/0/0.6/0.8"}}, file_), "");
    EXPECT_EQ(lost_of_link({{"planes", "1/2/3/1/1/0,1/2/3/1/0/0,1/2/3/0/1/1"}}, file_),
              "the link has 2 oblique clip planes; the first is shown");
    EXPECT_GT(cut, kPoints / 4);
    EXPECT_LT(cut, kPoints);
}

TEST_F(LinkView, ShowsPointsWhereThePagesCameraSeesThem) {
    // The page's camera: 40 degrees high, z is up, and points count from the first vertex.
    const glm::dvec3 eye(-30, -50, 22), target(9, 8, 7);
    const glm::dmat4 page = glm::perspective(glm::radians(40.0), 16.0 / 9.0, 0.1, 1000.0) *
                            glm::lookAt(eye, target, glm::dvec3(0, 0, 1));
    const ExplorerState state =
        reread("http://h/b.isochron#view=-30,-50,22,9,8,7&isovalue=0.5&step=1");
    EXPECT_EQ(state.isovalue(), 0.5);
    EXPECT_EQ(state.instant.step, 1u);
    const render::View view = stereo::view_of(kScreen.screen, kScreen.head, stereo::Eye::center, 0,
                                              0.05f, 50.0f, kScreen.pixels);
    const glm::dmat4 native = glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room) *
                              interaction::matrix(state.room_from_physical);
    const glm::dvec3 first(file_.info().grid.physical_from_index() * glm::dvec4(0, 0, 0, 1));
    std::mt19937 random(test_seed());
    std::uniform_real_distribution<double> any(-1, 1);
    const glm::dvec3 back = glm::normalize(eye - target);
    for (int i = 0; i < 100; ++i) { // in the plane of the target, where both have the same size
        glm::dvec3 off(any(random), any(random), any(random));
        off = 5.0 * (off - back * glm::dot(off, back));
        const glm::dvec4 in_page = page * glm::dvec4(target + off, 1),
                         here = native * glm::dvec4(target + off + first, 1);
        EXPECT_NEAR(here.x / here.w, in_page.x / in_page.w, 1e-4);
        EXPECT_NEAR(here.y / here.w, in_page.y / in_page.w, 1e-4);
    }
}

TEST_F(LinkView, IgnoresWhatIsNoSetting) {
    for (const std::string words :
         {"isovalue=1e999&step=-1&array=7&view=1,2,3",
          "isovalue=nan&step=99999999999&surfaces=,/,&picked=5",
          "view=1,1,1,1,1,1&clip=7,2&colors=-1&opacity=abc", "view=nan,1,1,1,1,1&isovalue=0x10",
          "%%%&&=&=;", "plane=1,2,3,0,0,0&up=0,0,0&range=2,1&map=none", "ghosts=5/0/1/0.5",
          "ghosts=1/1/0/0.5", "ghosts=1/1/1.5/0.5", "ghosts=0/0/1/1", "ghosts=1/1",
          "planes=1/2/3/0/0/0,a/b&box=0,0,0,1,1", "box=3,0,0,3,1,1", "box=20,0,0,30,1,1",
          "slices=1/2/3/0/0/0,1/2/3,a/b/c/d/e/f&alone=1"})
        EXPECT_EQ(
            reread("http://h/" + std::to_string(std::hash<std::string>()(words)) + "#" + words),
            ExplorerState())
            << words;
}

TEST(LinkAddresses, KeepTheTokenToThemselves) {
    using namespace index;
    EXPECT_EQ(address_of("http://h:1/x/#token=abc&file=a%20b.isochron&step=2"),
              "http://h:1/x/a%20b.isochron");
    EXPECT_EQ(authorization_for("http://h:1/x/a%20b.isochron"), "Bearer abc");
    EXPECT_EQ(authorization_for("http://h:1/y/a.isochron"), "");
    EXPECT_EQ(authorization_for("http://h:2/x/a.isochron"), "");
    EXPECT_EQ(settings_of_link("http://h:1/x/a%20b.isochron"),
              (std::map<std::string, std::string>{{"step", "2"}}));
    EXPECT_EQ(address_of("http://h/x/#file=../secret"), "http://h/x/");
    EXPECT_EQ(address_of("run#42.isochron"), "run#42.isochron");
    EXPECT_FALSE(is_link("httpd.isochron"));
    EXPECT_TRUE(is_link("HTTPS://h/a.isochron"));
}

} // namespace
} // namespace isochron::app
