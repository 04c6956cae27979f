// The place under the cursor is the picked place, by rays made from the views' own matrices.
#include "tests/interaction/input_builders.h"
#include "tests/support/session_fixture.h"
#include "tests/support/test_seed.h"

#include "index/volume/sample.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/input/actions.h"
#include "stereo/screen.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cstdio>

namespace isochron::app {
namespace {

using interaction::Key;
using interaction::KeyEvent;
using interaction::MouseMoveEvent;
using interaction::Pose;
using interaction::WindowEvent;

constexpr int kViews = 1000;
constexpr glm::ivec2 kWindow(160, 120);

/// A desktop: the head carries the screen.
Config desktop_config() {
    Config config = small_config(stereo::StereoMode::mono);
    stereo::Window& window = config.installation.windows.front();
    window.size = kWindow;
    window.viewports = {stereo::Viewport{}};
    window.viewports.front().screen = {.lower_left = {-0.9f, -0.5f, -1.2f},
                                       .upper_left = {-0.9f, 0.5f, -1.2f},
                                       .upper_right = {0.9f, 0.5f, -1.2f},
                                       .carried_by_head = true,
                                       .fit_aspect = true};
    return config;
}

/// The ray through the middle of a pixel of a view, in the room: from the eye to the point that its
/// matrices send to the far plane.
struct ReferenceRay {
    glm::dvec3 from, to;
};
ReferenceRay reference_ray(const render::View& view, glm::dvec2 pixel) {
    const glm::dmat4 room_from_clip =
        glm::inverse(glm::dmat4(view.clip_from_eye) * glm::dmat4(view.eye_from_room));
    const glm::dvec2 at = 2.0 * pixel / glm::dvec2(view.size) - 1.0;
    const auto place = [&](double depth) {
        const glm::dvec4 p = room_from_clip * glm::dvec4(at, depth, 1.0);
        return glm::dvec3(p) / p.w;
    };
    return {glm::dvec3(view.eye_in_room()), place(1.0)};
}

/// Where the values along the ray first pass the isovalue: by walking in steps of 0.01 voxel.
std::optional<glm::dvec3> first_crossing(const index::StepValues& values, const ReferenceRay& ray,
                                         const glm::dmat4& physical_from_room, double isovalue) {
    const glm::dvec3 from(physical_from_room * glm::dvec4(ray.from, 1.0));
    const glm::dvec3 to(physical_from_room * glm::dvec4(ray.to, 1.0));
    const double length = glm::distance(from, to);
    const glm::dvec3 way = (to - from) / length;
    const glm::dvec3 middle(15.5);
    const double about = glm::dot(middle - from, way); // the grid is within 27 voxels of it
    std::optional<double> before;
    constexpr double kStep = 0.01;
    const double nearest = std::max(about - 28.0, 0.0);
    const int steps = static_cast<int>((about + 28.0 - nearest) / kStep);
    for (int step = 0; step < steps; ++step) {
        const double at = nearest + step * kStep;
        const auto value = index::value_at(values, 0, from + at * way);
        if (value && before && (*value >= isovalue) != (*before >= isovalue)) {
            double low = at - kStep, high = at;
            for (int i = 0; i < 40; ++i) {
                const double half = (low + high) / 2;
                const auto there = index::value_at(values, 0, from + half * way);
                ((*there >= isovalue) == (*before >= isovalue) ? low : high) = half;
            }
            return from + high * way;
        }
        before = value;
    }
    return std::nullopt;
}

TEST(Pointing, PicksWhatIsUnderTheCursorInAnyViewAndStereoMode) {
    TestFolder folder;
    const auto file = build_sphere(folder.path(), 1);
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = kWindow});
    const Config config = desktop_config();
    Session session(config, file, *context);
    const index::LoadedStep loaded = file->load(0);
    const double isovalue = 6.3;
    interaction::Random random(test_seed());
    interaction::DesktopEmulation emulation({});
    emulation.set_eye([&](const Pose& head, const MouseMoveEvent& cursor) {
        return session.ray_at(cursor, head);
    });
    int differ = 0, hits = 0;
    double farthest = 0;
    for (int view = 0; view < kViews; ++view) {
        const bool both = view >= kViews * 3 / 4;
        const double time = 0.1 * view;
        if (view == 0 || view == kViews * 3 / 4) { // windows show a mode once they have drawn it
            interaction::Commands commands;
            commands.isovalue = isovalue;
            commands.stereo = both ? "side_by_side" : "mono";
            session.frame(emulation.poll(interaction::Seconds(time)), commands, Waiting::for_cells);
        }
        ExplorerState state = session.state();
        interaction::Similarity& volume = state.room_from_physical;
        volume.scale = 0.05;
        volume.rotation = glm::normalize(glm::dquat(interaction::random_rotation(random)));
        volume.translation = glm::dvec3(interaction::uniform(random, -0.4, 0.4),
                                        1.6 + interaction::uniform(random, -0.4, 0.4),
                                        interaction::uniform(random, -2.5, -0.8)) -
                             0.05 * (volume.rotation * glm::dvec3(15.5));
        emulation.stand({{static_cast<float>(interaction::uniform(random, -0.2, 0.2)), 1.6f, 0.0f},
                         static_cast<float>(interaction::uniform(random, -0.3, 0.3)),
                         static_cast<float>(interaction::uniform(random, -0.3, 0.3))});
        session.set_state(state);

        const glm::ivec2 pixel(random() % kWindow.x, random() % kWindow.y); // from the lower left
        const glm::dvec2 middle = glm::dvec2(pixel) + 0.5;
        const std::vector<WindowEvent> press{
            MouseMoveEvent{static_cast<float>(middle.x / kWindow.x),
                           static_cast<float>(1.0 - middle.y / kWindow.y), kWindow.x, kWindow.y},
            KeyEvent{Key::enter, true}, KeyEvent{Key::enter, false}};
        emulation.feed(press);
        const auto input = emulation.poll(interaction::Seconds(time + 0.01));
        session.commands_from(input);
        const auto mark = session.take_panel_commands().mark.value_or(interaction::Mark{}).point;
        emulation.poll(interaction::Seconds(time + 0.02)); // the key is up again
        session.commands_from(emulation.poll(interaction::Seconds(time + 0.03)));

        const int half = kWindow.x / 2;
        const bool right = both && pixel.x >= half;
        const stereo::Eye eye = !both   ? stereo::Eye::center
                                : right ? stereo::Eye::right
                                        : stereo::Eye::left;
        const render::View seen =
            stereo::view_of(config.installation.windows.front().viewports.front().screen,
                            *input.find("head")->pose, eye, session.state().eye_separation, 0.05f,
                            50.0f, both ? glm::ivec2(half, kWindow.y) : kWindow);
        const auto expected = first_crossing(
            loaded.values, reference_ray(seen, middle - glm::dvec2(right ? half : 0, 0)),
            glm::inverse(matrix(volume)), isovalue);
        hits += expected.has_value();
        const double off = expected && mark ? glm::distance(*expected, mark->position) : 0.0;
        farthest = std::max(farthest, off);
        differ += expected.has_value() != mark.has_value() || off > 0.01;
    }
    std::printf("%d views, %d hits: %d differ, farthest %.2g voxel\n", kViews, hits, differ,
                farthest);
    EXPECT_GT(hits, kViews / 8);
    EXPECT_LT(hits, kViews);
    EXPECT_LE(differ, kViews / 1000);
}

TEST(Pointing, AMissSaysSoAndHoveringTellsWhatIsThere) {
    TestFolder folder;
    const auto file = build_sphere(folder.path(), 1);
    const auto context = stereo::make_context(stereo::ContextKind::egl, {.size = kWindow});
    Session session(desktop_config(), file, *context);
    interaction::DesktopEmulation emulation({});
    emulation.set_eye([&](const Pose& head, const MouseMoveEvent& cursor) {
        return session.ray_at(cursor, head);
    });
    const auto frame = [&](std::vector<WindowEvent> events, double time) {
        emulation.feed(events);
        const auto input = emulation.poll(interaction::Seconds(time));
        interaction::Commands commands = session.commands_from(input);
        interaction::merge(commands, session.take_panel_commands());
        session.frame(input, commands, Waiting::for_cells);
        return session.outputs().display().read_window();
    };
    const MouseMoveEvent beside{0.01f, 0.01f, 160, 120}, onto{0.5f, 0.5f, 160, 120};
    for (const double time : {0.0, 0.2, 0.4}) // until it has settled
        frame({}, time);
    const render::Image away = frame({beside}, 0.5);
    const render::Image over = frame({onto}, 0.6);
    EXPECT_NE(away.rgba, over.rgba) << "a label shows what is under the cursor";
    EXPECT_FALSE(session.log().frames().back().redrawn) << "over the same picture";
    EXPECT_EQ(frame({beside}, 0.7).rgba, away.rgba);
    frame({onto}, 0.8);
    EXPECT_FALSE(session.state().mark.point);

    using interaction::MouseButton;
    using interaction::MouseButtonEvent;
    frame({MouseButtonEvent{MouseButton::left, true}}, 0.9);
    frame({MouseButtonEvent{MouseButton::left, false}}, 1.0);
    ASSERT_TRUE(session.state().mark.point) << "a click picks";
    EXPECT_TRUE(session.history().undo());
}

} // namespace
} // namespace isochron::app
