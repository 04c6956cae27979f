// The change of a ShellSplatting picture when the order of its cells changes: the surface must not
// pop when an eye crosses from one case of the traversal to the next.
#include "render/drawing/cell_pass.h"
#include "render/gl/render_target.h"
#include "tests/support/drawing/gl_test.h"
#include "tests/support/drawing/image_compare.h"

#include <glm/gtc/matrix_transform.hpp>
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/string_cast.hpp>

#include <functional>

namespace isochron::render {
namespace {

constexpr int kCells = 40;
constexpr int kPictureSize = 192;

/// The cells that the level set f = 0 crosses, with its normals.
std::vector<index::CellPoint> shell(const std::function<float(const glm::vec3&)>& f) {
    std::vector<index::CellPoint> points;
    for (int z = 0; z < kCells; ++z)
        for (int y = 0; y < kCells; ++y)
            for (int x = 0; x < kCells; ++x) {
                int above = 0;
                for (int corner = 0; corner < 8; ++corner)
                    above += f(glm::vec3(x + (corner & 1), y + (corner >> 1 & 1),
                                         z + (corner >> 2))) >= 0.0f;
                if (above == 0 || above == 8)
                    continue;
                const glm::vec3 at = glm::vec3(x, y, z) + 0.5f;
                glm::vec3 normal;
                for (int axis = 0; axis < 3; ++axis) {
                    glm::vec3 step(0.0f);
                    step[axis] = 0.5f;
                    normal[axis] = f(at - step) - f(at + step);
                }
                points.push_back({std::uint16_t(x), std::uint16_t(y), std::uint16_t(z), 0,
                                  packed_normal(glm::normalize(normal))});
            }
    return points;
}

float ball(const glm::vec3& p) {
    return 14.3f - glm::distance(p, glm::vec3(0.5f * kCells));
}

/// Waves with thin sheets, bridges and much overlap on the screen.
float gyroid(const glm::vec3& p) {
    const glm::vec3 q = 0.35f * p;
    return glm::dot(glm::sin(q), glm::vec3(std::cos(q.y), std::cos(q.z), std::cos(q.x)));
}

class Popping : public GlTest {
  protected:
    /// The picture from an eye in index coordinates that looks at a point.
    Image picture(const CellBuffers& cells, const glm::vec3& eye, const glm::vec3& at) {
        View view;
        view.size = {kPictureSize, kPictureSize};
        view.clip_from_eye = glm::perspective(1.0f, 1.0f, 0.05f, 500.0f);
        view.eye_from_room = glm::lookAt(eye, at, glm::vec3(0.1f, 0.9f, 0.3f));
        Placement placement;
        placement.extent = glm::vec3(kCells);
        target_.bind();
        target_.clear({0, 0, 0, 1});
        pass_.draw(view, placement, cells, Footprint::gaussian);
        return target_.read();
    }

    /// Compares the pictures on both sides of every change of order between two eyes, up to `most`.
    /// @return how many there were
    int expect_no_pop(const CellBuffers& cells, const glm::vec3& from, const glm::vec3& to,
                      int most) {
        const auto eye = [&](double t) { return glm::mix(from, to, float(t)); };
        const auto key = [&](double t) {
            return traversal_key(glm::vec4(eye(t), 1), glm::ivec3(kCells), glm::vec3(1.0f));
        };
        int changes = 0;
        double begin = 0.0;
        for (int i = 1; i <= 64 && changes < most; ++i) {
            double end = i / 64.0;
            if (key(begin) == key(end))
                continue;
            double low = begin, high = end;
            while (glm::distance(eye(low), eye(high)) > 1e-4f) {
                const double middle = 0.5 * (low + high);
                (key(middle) == key(low) ? low : high) = middle;
            }
            const glm::vec3 at = glm::vec3(0.5f * kCells) + glm::vec3(0.3f, 0.4f, 0.2f);
            EXPECT_TRUE(test_support::images_match(picture(cells, eye(low), at),
                                                   picture(cells, eye(high), at),
                                                   {.maximum = 32, .mean = 1.0}, "popping"))
                << "eye " << glm::to_string(eye(low));
            ++changes;
            begin = end;
        }
        return changes;
    }

    RenderTarget target_{gl_, {kPictureSize, kPictureSize}};
    CellPass pass_{gl_};
};

TEST_P(Popping, IsNotSeenWhereTheLongestAxisOfTheEyeChanges) {
    for (const auto& f : {ball, gyroid}) {
        const CellBuffers cells = showing(gl_, shell(f));
        const glm::vec3 middle(0.5f * kCells);
        for (const float distance : {30.0f, 60.0f}) {
            const auto at = [&](const glm::vec3& towards) { return middle + distance * towards; };
            EXPECT_GT(expect_no_pop(cells, at({1.02f, 0.98f, 0.3f}), at({0.98f, 1.02f, 0.3f}), 3),
                      0);
            EXPECT_GT(expect_no_pop(cells, at({0.2f, 0.98f, -1}), at({0.2f, 1.02f, -1}), 3), 0);
            EXPECT_GT(expect_no_pop(cells, at({1, 1.02f, 1}), at({1.02f, 0.98f, 1.02f}), 3), 0);
        }
    }
}

TEST_P(Popping, IsNotSeenWhereTheEyeEntersAnotherLayerOfCells) {
    for (const auto& f : {ball, gyroid}) {
        const CellBuffers cells = showing(gl_, shell(f));
        for (const glm::vec3& eye :
             {glm::vec3(20.37f, 20.61f, 20.23f), glm::vec3(9.37f, 12.61f, 11.23f),
              glm::vec3(-12.0f, 30.61f, 55.0f), glm::vec3(-0.5f, 40.5f, 39.5f)})
            EXPECT_GT(expect_no_pop(cells, eye, eye + glm::vec3(1.1f, -1.3f, 1.2f), 3), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(, Popping, both_contexts(), context_name);

} // namespace
} // namespace isochron::render
