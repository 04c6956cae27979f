// Bounds of boxes in views.
#include "render/culling/box_projection.h"
#include "tests/render/cells/random_views.h"
#include "tests/support/test_seed.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace isochron::render {
namespace {

struct Seen {
    glm::dvec2 low{1e9}, high{-1e9};
    double nearest = 1e9;
    void take(const glm::dvec4& clip, const glm::dvec2& size) {
        const glm::dvec2 pixel = 0.5 * size + glm::dvec2(clip) / clip.w; // x and y are in pixels
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
        nearest = std::min(nearest, 0.5 + 0.5 * clip.z / clip.w);
    }
};

TEST(BoxProjection, BoundsHoldAllOfABoxAndLittleMore) {
    std::mt19937 random(test_seed());
    double area = 0, exact = 0;
    for (int i = 0; i < 2000; ++i) {
        const Scene scene = random_scene(random);
        const glm::vec3 middle = glm::vec3(scene.cell) + 0.5f;
        const auto bounds =
            BoxProjection(scene.view, scene.placement).bounds(middle, glm::vec3(0.5f));
        ASSERT_TRUE(bounds);
        Seen box, larger;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
            box.take(scene.pixel_from_index() * glm::dvec4(glm::dvec3(scene.cell) + side, 1.0),
                     scene.view.size);
            larger.take(scene.pixel_from_index() *
                            glm::dvec4(glm::dvec3(middle) + 2.0 * (side - 0.5), 1.0),
                        scene.view.size);
        }
        EXPECT_LE(bounds->low.x, box.low.x);
        EXPECT_LE(bounds->low.y, box.low.y);
        EXPECT_GE(bounds->high.x, box.high.x);
        EXPECT_GE(bounds->high.y, box.high.y);
        EXPECT_LE(bounds->nearest, box.nearest);
        EXPECT_GE(bounds->nearest, larger.nearest - 1e-5);
        const glm::vec2 size = bounds->high - bounds->low;
        const glm::dvec2 exact_size = box.high - box.low;
        area += double{size.x * size.y};
        exact += exact_size.x * exact_size.y;
    }
    EXPECT_LT(area, 1.5 * exact);
}

TEST(BoxProjection, NothingIsSeenBehindTheEyeOrBesideTheViewAndAllMayBeNearTheEye) {
    std::mt19937 random(test_seed());
    for (int i = 0; i < 500; ++i) {
        const Scene scene = random_scene(random);
        if (scene.view.is_parallel())
            continue;
        const BoxProjection projection(scene.view, scene.placement);
        const glm::vec3 middle = glm::vec3(scene.cell) + 0.5f;
        const glm::vec3 eye(glm::inverse(scene.placement.room_from_index) *
                            glm::vec4(scene.view.eye_in_room(), 1.0f));
        EXPECT_FALSE(projection.bounds(eye - 4.0f * (middle - eye), glm::vec3(0.5f)));
        const auto around_eye = projection.bounds(eye, glm::vec3(0.5f));
        ASSERT_TRUE(around_eye);
        EXPECT_EQ(around_eye->low, glm::vec2(0.0f));
        EXPECT_EQ(around_eye->high, glm::vec2(scene.view.size));
        EXPECT_LT(around_eye->nearest, 0.0f);
        View beside = scene.view;
        // The view's middle moves by ten of its widths.
        beside.clip_from_eye =
            glm::translate(glm::mat4(1.0f), glm::vec3(20.0f, 0, 0)) * beside.clip_from_eye;
        EXPECT_FALSE(BoxProjection(beside, scene.placement).bounds(middle, glm::vec3(0.5f)));
    }
}

} // namespace
} // namespace isochron::render
