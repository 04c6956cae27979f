// Light: samples and blending average linear light, and surfaces send out no more light than they
// get.
#include "render/drawing/cell_pass.h"
#include "render/gl/driver.h"
#include "render/gl/render_target.h"
#include "render/gl/srgb.h"
#include "render/passes/color_map.h"
#include "render/passes/line_pass.h"
#include "tests/support/drawing/gl_test.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <map>

namespace isochron::render {
namespace {

constexpr int kLitSize = 64;
constexpr int kHalfLight = 188; ///< half the light of white, as sRGB

class Lights : public GlTest {
  protected:
    Lights() {
        view_.size = {kLitSize, kLitSize};
        view_.clip_from_eye = glm::perspective(0.5f, 1.0f, 0.1f, 200.0f);
        placement_.room_from_index = glm::translate(glm::mat4(1.0f), {-8, -8, -60});
        placement_.extent = glm::vec3(16);
        look_.depth_cue = look_.reflectance = look_.key_light = look_.outline = look_.ambient = 0;
        look_.head_light = 1;
    }
    /// A wall of cells towards the viewer. @return its picture before black
    Image wall(Footprint footprint, std::uint16_t style = 0) {
        std::vector<index::CellPoint> points;
        for (std::uint16_t y = 0; y < 16; ++y)
            for (std::uint16_t x = 0; x < 16; ++x)
                points.push_back({x, y, 8, style, packed_normal({0, 0, 1})});
        target_.bind();
        target_.clear({0, 0, 0, 0});
        pass_.draw(view_, placement_, showing(gl_, points), footprint, look_);
        return target_.read();
    }
    View view_;
    Placement placement_;
    CellAppearance look_;
    RenderTarget target_{gl_, {kLitSize, kLitSize}};
    CellPass pass_{gl_, {.shape = CellShape::voxel}}, planes_{gl_};
};

TEST_P(Lights, BlendAsLightDoes) {
    target_.bind();
    target_.clear({0, 0, 0, 1});
    LinePass lines(gl_);
    lines.draw(view_, glm::mat4(1.0f),
               std::vector<Line>{{{-9, 0, -20}, {9, 0, -20}, {1, 1, 1, 0.5f}}}, 20.0f);
    EXPECT_NEAR(target_.read().at(32, 32)[0], kHalfLight, 1);
}

TEST_P(Lights, OfSamplesAreAveraged) {
    ASSERT_GE(max_samples(gl_), 4);
    RenderTarget target(gl_, {kLitSize, kLitSize}, 4);
    target.bind();
    target.clear({0, 0, 0, 1});
    // White cells whose upright edges fall where they may: of every step of a quarter there are
    // pixels, and each is as light as that share of white.
    for (auto& surface : look_.surfaces)
        surface.color = glm::vec3(1);
    std::map<int, int> levels;
    for (int shift = 0; shift < 8; ++shift) {
        target.clear({0, 0, 0, 1});
        placement_.room_from_index =
            glm::translate(glm::mat4(1.0f), {-0.5f + 0.06f * float(shift), -0.5f, -60});
        pass_.draw(view_, placement_, showing(gl_, cell_set({{0, 0, 8}})), Footprint::quad, look_);
        target.resolve();
        const Image image = target.read();
        for (std::size_t i = 0; i < image.rgba.size(); i += 4)
            ++levels[image.rgba[i]];
    }
    for (const auto& [level, count] : levels) {
        const float quarters = 4 * linear_from_srgb(static_cast<float>(level) / 255.0f);
        EXPECT_NEAR(quarters, std::round(quarters), 0.04) << level;
    }
    EXPECT_GE(levels.size(), 3u) << "no pixel was covered in part";
}

TEST_P(Lights, OfAClearAreTheDisplayValuesAskedFor) {
    for (const int samples : {1, 4}) {
        RenderTarget target(gl_, {8, 8}, samples);
        target.clear({0.2f, 0.5f, 0.8f, 1});
        target.resolve();
        const Image image = target.read();
        EXPECT_NEAR(image.at(3, 3)[0], 51, 1);
        EXPECT_NEAR(image.at(3, 3)[1], 128, 1);
        EXPECT_NEAR(image.at(3, 3)[2], 204, 1);
    }
}

TEST_P(Lights, TooManySamplesAreAnErrorThatSaysHowManyThereAre) {
    try {
        RenderTarget target(gl_, {8, 8}, max_samples(gl_) + 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(std::to_string(max_samples(gl_))),
                  std::string::npos)
            << error.what();
    }
}

TEST_P(Lights, OfAQuadAreItsSurfacesColorWhetherConvertedByShaderOrTarget) {
    look_.surfaces[5].color = {0.25f, 0.5f, 0.75f};
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian})
        for (const bool linear : {true, false}) {
            look_.linear_light = linear;
            const Image image = wall(footprint, 5);
            for (const auto& [channel, value] : {std::pair{0, 64}, {1, 128}, {2, 191}})
                EXPECT_NEAR(image.at(32, 32)[channel], value, 3) << int(footprint) << linear;
        }
}

TEST_P(Lights, ThroughATransparentSurfaceAreTheShareThatWasAskedFor) {
    // The share holds for a surface that slants any way: this wall has one cell for each unit of
    // its area instead of one and a half, so that it lets more through, by just that power.
    for (const float opacity : {0.0f, 0.25f, 0.5f, 0.75f, 0.95f}) {
        look_.surfaces[2].opacity = opacity;
        const Image image = wall(Footprint::gaussian, 2);
        const float expected = 1 - std::pow(1 - opacity, 1 / 1.5f);
        EXPECT_NEAR(image.at(32, 32)[3] / 255.0, expected, 0.03) << opacity;
    }
    look_.surfaces[2].opacity = 1.0f;
    EXPECT_GT(wall(Footprint::gaussian, 2).at(32, 32)[3], 245);
}

TEST_P(Lights, OfFastQuadsPassThroughTheCellsThatAreLeftOut) {
    look_.surfaces[2].opacity = 0.4f;
    const Image image = wall(Footprint::quad, 2), again = wall(Footprint::quad, 2);
    EXPECT_EQ(image.rgba, again.rgba);
    look_.surfaces[2].opacity = 1.0f;
    const Image full = wall(Footprint::quad, 2);
    int seen = 0, all = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        seen += image.rgba[i] > 0;
        all += full.rgba[i] > 0;
    }
    EXPECT_GT(seen, 0.4 * all); // quads overlap
    EXPECT_LT(seen, 0.85 * all);
}

TEST_P(Lights, TakeTheirColorFromTheMapAtTheValue) {
    const Texture map = color_map_texture(gl_, color_map(ColorMap::inferno));
    const auto colors = color_map(ColorMap::inferno);
    look_.values =
        ValueColors{.map = map.name(), .low = 0.25f, .high = 0.75f, .no_value = {1, 0, 0}};
    const auto style = [](unsigned coordinate) { return std::uint16_t(coordinate << 3 | 3); };
    const auto expect = [&](unsigned coordinate, const glm::vec3& light) {
        const Image image = wall(Footprint::quad, style(coordinate));
        const glm::vec3 shown = 255.0f * srgb_from_linear(light);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(image.at(32, 32)[channel], shown[channel], 3) << coordinate;
    };
    expect(8190 / 2, 0.5f * (colors[127] + colors[128]));
    expect(8190 / 4, colors.front());
    expect(0, colors.front()); // below the range
    expect(8190, colors.back());
    expect(8191, {1, 0, 0}); // no value
    // By logarithms: from 1 to 100, 10 is in the middle.
    look_.values->low = 0.01f;
    look_.values->high = 1.0f;
    look_.values->ratio = 100.0f;
    expect(819, 0.5f * (colors[127] + colors[128]));
    expect(82, colors.front());
    expect(8190, colors.back());
}

TEST_P(Lights, OfBandsDoNotFlowIntoEachOther) {
    const auto bands = used(color_map(ColorMap::inferno), {.bands = 2});
    const Texture map = color_map_texture(gl_, bands);
    look_.values = ValueColors{.map = map.name(), .bands = true};
    for (const unsigned coordinate : {0u, 4000u, 4094u, 4096u, 4100u, 8190u}) {
        const Image image = wall(Footprint::quad, std::uint16_t(coordinate << 3 | 3));
        const glm::vec3 shown =
            255.0f * srgb_from_linear(coordinate < 4095 ? bands.front() : bands.back());
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(image.at(32, 32)[channel], shown[channel], 3) << coordinate;
    }
}

TEST_P(Lights, OfTheKeyStandStillInTheRoomWhileTheHeadTurns) {
    look_.head_light = 0;
    look_.key_light = 1;
    look_.key_direction = {0, 0, 1};
    const int before = wall(Footprint::quad).at(32, 32)[0];
    // The head goes to the side and looks back: the wall faces the light as before.
    view_.eye_from_room =
        glm::lookAt(glm::vec3(40, 0, 0), glm::vec3(0, 0, -51.5f), glm::vec3(0, 1, 0));
    EXPECT_NEAR(wall(Footprint::quad).at(32, 32)[0], before, 2);
    EXPECT_GT(before, 200);
    look_.key_direction = {1, 0, 0}; // grazes the wall
    EXPECT_LT(wall(Footprint::quad).at(32, 32)[0], 5);
}

INSTANTIATE_TEST_SUITE_P(, Lights, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
