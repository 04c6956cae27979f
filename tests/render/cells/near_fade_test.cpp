// Fading near a viewer follows the distances, and is the same for both eyes.
#include "tests/render/cells/surface_agreement.h"
#include "tests/support/test_field.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>

namespace isochron::render {
namespace {

using index::TestField;
using index::ValueType;

constexpr double kScale = 0.25; ///< so small that grains are some pixels wide
constexpr glm::vec3 kHead(0.01f, 0.02f, 0.3f);
constexpr NearFade kFade{.gone = 0.12f, .whole = 0.28f, .between_eyes = kHead};
constexpr glm::ivec2 kSize(400, 400);

class NearFadeTest : public SurfaceTest {
  protected:
    static CellAppearance appearance(float opacity, bool fades) {
        CellAppearance look;
        look.surfaces[0].opacity = opacity;
        if (fades)
            look.near_fade = kFade;
        return look;
    }
    /// An eye at the side of the head.
    static View eye(float aside) {
        View view = perspective_view(kHead + glm::vec3(aside, 0, 0));
        view.size = kSize;
        return view;
    }
    SurfacePicture picture(const View& view, float opacity, bool fades) {
        return draw(field_, placement_, std::span(&view, 1), kSize, appearance(opacity, fades));
    }
    /// Where a pixel's surface is in the room.
    static glm::dvec3 place(const SurfacePicture& picture, const View& view, int x, int y) {
        const glm::dmat4 room_from_clip =
            glm::inverse(glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room));
        const glm::dvec4 at =
            room_from_clip * glm::dvec4(2 * (x + 0.5) / kSize.x - 1, 2 * (y + 0.5) / kSize.y - 1,
                                        2.0 * picture.depth(x, y) - 1, 1);
        return glm::dvec3(at) / at.w;
    }
    static double share(const glm::dvec3& at) {
        const double distance = glm::distance(at, glm::dvec3(kHead));
        return std::clamp((distance - kFade.gone) / (kFade.whole - kFade.gone), 0.0, 1.0);
    }
    template <class Each>
    static void for_each_pixel(const SurfacePicture& picture, Each&& each) {
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x)
                if (picture.covered(x, y))
                    each(x, y);
    }

    const TestField smooth_{{24, 20, 22}, 1, ValueType::f32, index::turbulence(random_, 24)};
    const VertexField field_{smooth_.view(), {index::Instant(0), 0.03}};
    const Placement placement_ =
        placed_at_origin(smooth_.view().grid, glm::scale(glm::dmat4(1.0), glm::dvec3(kScale)));
};

TEST_P(NearFadeTest, OpaqueSurfacesShowTheShareOfTheirGrainsThatTheDistanceSays) {
    const View view = eye(0.03f);
    const SurfacePicture whole = picture(view, 1.0f, false), faded = picture(view, 1.0f, true);
    std::array<double, 10> expected{}, drawn{}, pixels{};
    for_each_pixel(whole, [&](int x, int y) {
        const double wanted = share(place(whole, view, x, y));
        const auto bin = std::min(std::size_t(wanted * 10), std::size_t{9});
        // A grain that is left out may show what is behind it.
        const bool same = std::abs(faded.depth(x, y) - whole.depth(x, y)) < 1e-5f;
        expected[bin] += wanted;
        drawn[bin] += same;
        ++pixels[bin];
        if (wanted == 0) {
            EXPECT_FALSE(same);
        } else if (wanted == 1) {
            EXPECT_TRUE(same);
        }
    });
    int compared = 0;
    for (std::size_t bin = 0; bin < pixels.size(); ++bin)
        if (pixels[bin] > 300) {
            ++compared;
            // Five standard deviations of grains of a few pixels each.
            EXPECT_NEAR(drawn[bin] / pixels[bin], expected[bin] / pixels[bin],
                        5 * 0.5 * std::sqrt(4 / pixels[bin]))
                << "of " << pixels[bin] << " in bin " << bin;
        }
    EXPECT_GE(compared, 4);
}

TEST_P(NearFadeTest, BlendedSurfacesHaveTheOpacityThatTheDistanceSays) {
    const View view = eye(0.03f);
    constexpr float kOpacity = 0.6f;
    const SurfacePicture opaque = picture(view, 1.0f, false);
    const SurfacePicture whole = picture(view, kOpacity, false);
    const SurfacePicture faded = picture(view, kOpacity, true);
    int compared = 0;
    for_each_pixel(opaque, [&](int x, int y) {
        const glm::vec4 shown = whole.normals[whole.index(x, y)];
        const glm::vec3 nearest(opaque.normals[opaque.index(x, y)]);
        const float behind = glm::distance(glm::vec3(shown) / shown.w, nearest);
        if (shown.w > 0.9f || behind > 1e-4f * glm::length(nearest))
            return; // several layers, or a rim that may hide one
        const double wanted = shown.w * share(place(opaque, view, x, y));
        EXPECT_NEAR(faded.normals[faded.index(x, y)].w, wanted, 2e-3);
        ++compared;
    });
    EXPECT_GT(compared, 500);
}

TEST_P(NearFadeTest, BothEyesMissTheSameGrains) {
    const std::array<View, 2> eyes{eye(-0.03f), eye(0.03f)};
    std::array<SurfacePicture, 2> whole, faded;
    for (std::size_t i = 0; i < 2; ++i) {
        whole[i] = picture(eyes[i], 1.0f, false);
        faded[i] = picture(eyes[i], 1.0f, true);
    }
    const auto is_drawn = [&](std::size_t i, int x, int y) {
        return std::abs(faded[i].depth(x, y) - whole[i].depth(x, y)) < 1e-5f;
    };
    const glm::dmat4 to_other =
        glm::dmat4(eyes[1].clip_from_eye) * glm::dmat4(eyes[1].eye_from_room);
    int seen = 0, same = 0, left_out = 0;
    for_each_pixel(whole[0], [&](int x, int y) {
        const glm::dvec3 at = place(whole[0], eyes[0], x, y);
        const double wanted = share(at);
        if (wanted < 0.2 || wanted > 0.8)
            return;
        const glm::dvec4 clip = to_other * glm::dvec4(at, 1);
        const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
        const glm::ivec2 other(glm::floor((glm::dvec2(ndc) * 0.5 + 0.5) * glm::dvec2(kSize)));
        if (other.x < 0 || other.y < 0 || other.x >= kSize.x || other.y >= kSize.y ||
            glm::distance(place(whole[1], eyes[1], other.x, other.y), at) > 0.001)
            return; // hidden from the other eye
        ++seen;
        left_out += !is_drawn(0, x, y);
        same += is_drawn(0, x, y) == is_drawn(1, other.x, other.y);
    });
    ASSERT_GT(seen, 1000);
    EXPECT_GT(left_out, 0.2 * seen);
    // Chosen by each eye for itself, little more than half would agree; pixels on the borders of
    // grains may not.
    EXPECT_GT(same, 0.75 * seen) << "of " << seen;
}

/// Cells one by one, each in pixels of its own.
TEST_P(NearFadeTest, SplatsFadeByTheDistanceOfTheirCellsAndQuadsAreThereOrNot) {
    const TestField plain({5, 5, 40}, 1, ValueType::f32, [](auto...) { return 0.0; });
    const index::Grid grid = plain.view().grid;
    const Placement placement =
        placed_at_origin(grid, glm::scale(glm::dmat4(1.0), glm::dvec3(kScale)));
    Extractions extractions(plain.view());
    CellPass pass(gl_);
    CellBuffers cells(gl_, grid);
    const View view = eye(0.0f);
    const auto alpha_of = [&](std::uint32_t z, Footprint footprint, bool fades) {
        const auto one = extractions.of_cells(0, {{(z * 4 + 2) * 4 + 2}});
        while (cells.shown() != one)
            cells.upload(one, std::size_t{1} << 30);
        const Texture color(gl_, GL_TEXTURE_2D);
        gl_.TextureStorage2D(color.name(), 1, GL_RGBA32F, kSize.x, kSize.y);
        const Framebuffer framebuffer(gl_);
        gl_.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, color.name(), 0);
        constexpr glm::vec4 kNothing(0.0f);
        gl_.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, &kNothing.x);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        pass.draw(view, placement, cells, footprint, appearance(1.0f, fades));
        std::vector<glm::vec4> pixels(std::size_t(kSize.x) * kSize.y);
        gl_.ReadPixels(0, 0, kSize.x, kSize.y, GL_RGBA, GL_FLOAT, pixels.data());
        float most = 0;
        for (const glm::vec4& pixel : pixels)
            most = std::max(most, pixel.w);
        return most;
    };
    int part = 0, there = 0;
    double expected_there = 0;
    for (std::uint32_t z = 0; z < 39; ++z) {
        const glm::dvec3 center(placement.room_from_index *
                                glm::vec4(2.5f, 2.5f, static_cast<float>(z) + 0.5f, 1));
        const double wanted = share(center);
        part += wanted > 0 && wanted < 1;
        const float whole = alpha_of(z, Footprint::gaussian, false);
        EXPECT_NEAR(alpha_of(z, Footprint::gaussian, true), wanted * whole, 1e-4) << z;
        const float quad = alpha_of(z, Footprint::quad, true);
        EXPECT_EQ(quad, quad > 0 ? 1.0f : 0.0f);
        if (wanted == 0 || wanted == 1) {
            EXPECT_EQ(quad, wanted);
        }
        there += quad > 0;
        expected_there += wanted;
    }
    EXPECT_GT(part, 5);
    EXPECT_NEAR(there, expected_there, 4 * 0.5 * std::sqrt(part));
}

INSTANTIATE_TEST_SUITE_P(Contexts, NearFadeTest, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
