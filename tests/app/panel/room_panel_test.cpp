// The panel in the room, operated by a wand: both eyes see it, before and behind the surface, and a
// replay repeats it.
#include "tests/app/panel/room_panel_fixture.h"

#include "tests/support/drawing/sphere_oracle.h"

#include "app/loop/replay.h"
#include "app/scene/font.h"
#include "interaction/input/actions.h"
#include "interaction/navigation/navigation.h"

#include <gmock/gmock.h>

#include <cmath>

namespace isochron::app {
namespace {

using interaction::WandButton;
using render::Footprint;
using render::Image;
using test_support::PinholeEye;

constexpr std::uint64_t kTrigger = bit(WandButton::grab);

struct Rgb {
    int r, g, b;
};
constexpr Rgb kTitle{39, 70, 107}, kBar{36, 39, 44}, kPaper{28, 30, 34}, kBackground{14, 16, 20};

bool near(const std::uint8_t* pixel, Rgb color) {
    return std::abs(pixel[0] - color.r) <= 3 && std::abs(pixel[1] - color.g) <= 3 &&
           std::abs(pixel[2] - color.b) <= 3;
}

/// Where a place of the panel, in its own pixels, is in the room.
glm::vec3 in_room(const Session& session, glm::vec2 pixels) {
    return interaction::place_on(session.state().room_panel.pose, session.room_panel_size(),
                                 pixels / PanelInRoom::kPixels);
}

/// The volume far behind, and small.
Commands without_volume() {
    Commands commands;
    commands.room_from_physical = interaction::Similarity{{0, 30, -40}, {1, 0, 0, 0}, 1e-3};
    return commands;
}

TEST_P(RoomPanelTest, EachEyeSeesItsPartsWhereTheGeometryPutsThem) {
    Session session(panel_config(kWindow), file_, *context_);
    settle(session, without_volume(), std::nullopt);
    const glm::vec2 size = PanelInRoom::kPixels;
    std::array<double, 2> middle{};
    for (const stereo::Eye eye : {stereo::Eye::left, stereo::Eye::right}) {
        const Image image = session.outputs().display().read_eye(eye);
        const PinholeEye pinhole(session.outputs().display().window().viewports.front().screen,
                                 *head_at_rest(0).devices.front().pose, eye,
                                 session.state().eye_separation, {image.width, image.height});
        const auto at = [&](glm::vec2 pixels) {
            const auto pixel = pinhole.pixel_of(in_room(session, pixels));
            EXPECT_TRUE(pixel) << pixels.x << ", " << pixels.y;
            return image.at(static_cast<int>(pixel->x), static_cast<int>(pixel->y));
        };
        for (const float x : {200.0f, 300.0f, size.x - 12})
            EXPECT_TRUE(near(at({x, 11}), kTitle)) << "the title, " << x;
        for (const float y : {80.0f, 200.0f, 400.0f})
            EXPECT_TRUE(near(at({3, y}), kPaper)) << "the left margin, " << y;
        for (const float y : {40.0f, size.y - 12})
            EXPECT_TRUE(near(at({3, y}), kBar)) << "the bars above and below, " << y;
        // Three of its pixels, 3 mm, to either side of its edges.
        EXPECT_TRUE(near(at({-3, 300}), kBackground));
        EXPECT_TRUE(near(at({size.x / 2, size.y - 3}), kBar));
        EXPECT_TRUE(near(at({size.x / 2, size.y + 3}), kBackground));
        EXPECT_TRUE(near(at({size.x - 40, 18}), kTitle));
        EXPECT_FALSE(near(at({size.x - 40, 28}), kTitle));
        middle[eye == stereo::Eye::right] = pinhole.pixel_of(in_room(session, size / 2.0f))->x;
    }
    EXPECT_GT(middle[0], middle[1] + 10) << "it stands before the screen";
}

TEST_P(RoomPanelTest, TheRayThatPointsAtItIsSeenBeforeIt) {
    Session session(panel_config(kWindow), file_, *context_);
    const glm::vec2 pointed(0.4f, 0.3f);
    settle(session, without_volume(), pointed);
    const Pose wand = *wand_at(session, pointed).pose;
    const glm::dvec3 end(in_room(session, pointed * PanelInRoom::kPixels));
    for (const stereo::Eye eye : {stereo::Eye::left, stereo::Eye::right}) {
        const Image image = session.outputs().display().read_eye(eye);
        const PinholeEye pinhole(session.outputs().display().window().viewports.front().screen,
                                 *head_at_rest(0).devices.front().pose, eye,
                                 session.state().eye_separation, {image.width, image.height});
        for (const double part : {0.8, 0.9, 0.95}) { // over the panel for both eyes
            const auto pixel = pinhole.pixel_of(glm::mix(glm::dvec3(wand.position), end, part));
            ASSERT_TRUE(pixel);
            const std::uint8_t* color =
                image.at(static_cast<int>(pixel->x), static_cast<int>(pixel->y));
            EXPECT_GT(color[0], color[2] + 60) << "orange, at " << part;
        }
    }
}

TEST_P(RoomPanelTest, StaysReadableWhateverSurfaceIsNearer) {
    for (const Footprint footprint : {Footprint::quad, Footprint::gaussian, Footprint::surface}) {
        Config config = panel_config(kWindow);
        config.quality.settled = footprint;
        Session session(config, file_, *context_);
        const glm::dvec3 panel(session.state().room_panel.pose.position);
        for (const double before : {0.1, -0.1}) { // [m] of the panel, towards the eyes
            const glm::dvec3 eyes(0, 1.5, 0);
            Commands commands;
            interaction::Similarity placement{{}, {1, 0, 0, 0}, 0.005};
            // A sphere of 5 voxels about (12, 15.5, 15.5) at step 0.
            placement.translation = panel + before * glm::normalize(eyes - panel) -
                                    placement.scale * glm::dvec3(12, 15.5, 15.5);
            commands.room_from_physical = placement;
            commands.isovalue = 11;
            commands.quality = footprint == Footprint::quad ? interaction::QualityMode::fast
                                                            : interaction::QualityMode::quality;
            settle(session, commands, std::nullopt);
            EXPECT_EQ(session.log().frames().back().footprint, footprint);
            const Image image = session.outputs().display().read_eye(stereo::Eye::left);
            const PinholeEye eye(session.outputs().display().window().viewports.front().screen,
                                 *head_at_rest(0).devices.front().pose, stereo::Eye::left,
                                 session.state().eye_separation, {image.width, image.height});
            const auto pixel = eye.pixel_of(panel + before * glm::normalize(eyes - panel));
            const std::uint8_t* color =
                image.at(static_cast<int>(pixel->x), static_cast<int>(pixel->y));
            EXPECT_FALSE(color[0] > color[2] + 12) << "the sphere covers it: " << name_of(footprint)
                                                   << ", " << before << " m before it";
        }
    }
}

/// The middle of its histogram, below the title, the bar of buttons and the names of the sections.
constexpr float kHistogramY = 180;

TEST_P(RoomPanelTest, WhoAsksAgainForTheCommandsOfAFrameGetsTheSame) {
    Session session(panel_config(kWindow), file_, *context_);
    const auto pointing = [&](float x, std::uint64_t buttons) {
        InputState state = input();
        state.devices.push_back(
            wand_at(session, glm::vec2(x, kHistogramY) / PanelInRoom::kPixels, buttons));
        return state;
    };
    int dragged = 0;
    for (int i = -3; i < 8; ++i) { // three frames to come to rest on it
        const InputState state =
            pointing(100 + 20 * static_cast<float>(std::max(i, 0)), i < 0 ? 0 : kTrigger);
        const Commands commands = session.commands_from(state);
        const auto differ = interaction::differences(session.commands_from(state), commands);
        EXPECT_THAT(differ, testing::IsEmpty()) << i;
        dragged += commands.isovalue.has_value();
        session.frame(state, commands, Waiting::for_cells);
    }
    EXPECT_GT(dragged, 4) << "the line of the surface follows the ray";
}

class WandSession {
  public:
    WandSession(Session& session, Image (*picture)(const Session&))
        : session_(session), picture_(picture) {
        recording_.header.start = session.state().as_commands();
    }
    /// As the explorer does it, but for the clock.
    void frame(const InputState& input) {
        Commands commands = session_.commands_from(input);
        const Commands from_panel = session_.take_panel_commands();
        interaction::merge(commands, from_panel);
        session_.frame(input, commands, Waiting::for_cells);
        recording_.frames.push_back({input, commands, from_panel, ""});
        pictures_.push_back(picture_(session_));
    }
    interaction::Recording& recording() { return recording_; }
    const std::vector<Image>& pictures() const { return pictures_; }

  private:
    Session& session_;
    Image (*picture_)(const Session&);
    interaction::Recording recording_;
    std::vector<Image> pictures_;
};

Image window_of(const Session& session) {
    return session.outputs().display().read_window();
}

TEST_P(RoomPanelTest, AWandsRayMovesTheIsovalueAndAReplayFromDevicesRepeatsItAndItsPictures) {
    const auto small = [] {
        Config config = panel_config({400, 200});
        config.start.quality = interaction::QualityMode::fast;
        return config;
    };
    const auto context = stereo::make_context(GetParam(), {.size = {400, 200}});
    Session live(small(), file_, *context);
    WandSession wand(live, window_of);
    const auto point = [&](float x, std::uint64_t buttons) {
        InputState state = input();
        state.devices.push_back(
            wand_at(live, glm::vec2(x, kHistogramY) / PanelInRoom::kPixels, buttons));
        wand.frame(state);
    };
    for (int i = 0; i < 3; ++i)
        point(100, 0);
    for (int i = 0; i <= 10; ++i)
        point(100 + 20.0f * static_cast<float>(i), kTrigger);
    const double dragged = live.state().isovalue();
    for (int i = 0; i < 3; ++i)
        point(300, 0);

    const auto& stats = file_->stats();
    EXPECT_NEAR((live.state().isovalue() - stats.low) / (stats.high - stats.low), 300.0 / 400.0,
                0.03);
    EXPECT_NE(dragged, live.home().isovalue());
    int moved = 0, pulses = 0;
    for (const interaction::RecordedFrame& frame : wand.recording().frames) {
        moved += frame.commands.isovalue.has_value();
        pulses += static_cast<int>(frame.commands.haptics.size());
        EXPECT_TRUE(frame.from_panel.empty()) << "the devices explain it";
        EXPECT_FALSE(frame.commands.room_from_physical) << "the wand holds the world as well";
    }
    EXPECT_GE(moved, 9);
    EXPECT_GE(pulses, 2) << "entering the histogram, and pressing it";

    const auto again = stereo::make_context(GetParam(), {.size = {400, 200}});
    const auto replay = [&](std::vector<Image>* pictures) {
        Session session(small(), file_, *again);
        session.set_state(start_of(wand.recording().header, session.state(), 6, {}));
        return replay_fixed_step(session, wand.recording(),
                                 {.from_devices = true, .stereo = {}, .quality = {}},
                                 [&](std::size_t, const interaction::RecordedFrame&) {
                                     if (pictures)
                                         pictures->push_back(window_of(session));
                                 });
    };
    std::vector<Image> pictures;
    EXPECT_THAT(replay(&pictures), testing::IsEmpty());
    ASSERT_EQ(pictures.size(), wand.pictures().size());
    for (std::size_t i = 0; i < pictures.size(); ++i)
        EXPECT_EQ(pictures[i].rgba, wand.pictures()[i].rgba) << "frame " << i;

    // A hand that had pointed elsewhere explains other commands.
    wand.recording().frames[8].input.devices.back().pose->position.x += 0.05f;
    EXPECT_THAT(replay(nullptr), testing::Not(testing::IsEmpty()));
}

TEST_P(RoomPanelTest, ItsTitleCarriesItAndTheRecordingHoldsWhereTo) {
    Session session(panel_config({256, 128}), file_, *context_);
    WandSession wand(session, window_of);
    const Pose start = session.state().room_panel.pose;
    InputState state = input();
    state.devices.push_back(wand_at(session, {0.5f, 0.02f}));
    const Pose first = *state.devices.back().pose;
    wand.frame(state);
    wand.frame(state); // its title is known once it has been laid out
    for (int i = 0; i < 4; ++i) {
        state.devices.back().buttons = kTrigger;
        state.devices.back().pose->orientation =
            glm::angleAxis(0.1f * static_cast<float>(i), glm::vec3(0, 1, 0)) * first.orientation;
        wand.frame(state);
    }
    EXPECT_GT(glm::distance(session.state().room_panel.pose.position, start.position), 0.05);
    ASSERT_TRUE(wand.recording().frames.back().commands.room_panel);
    EXPECT_EQ(wand.recording().frames.back().commands.room_panel->pose,
              session.state().room_panel.pose);
    EXPECT_FALSE(wand.recording().frames.back().commands.room_from_physical);
}

TEST(RoomPanelLetters, AreLargeEnoughAtArmsLength) {
    const PanelConfig defaults;
    const render::GlyphAtlas font = room_font(150);
    const render::Glyph* x = font.find(U'x');
    ASSERT_TRUE(x);
    const float kMargins =
        2 * (static_cast<float>(font.halo.y) + 1) / 150.0f; // margins of the glyph's rectangle
    const float x_height = (x->high.y - x->low.y - kMargins) * PanelLayer::kFontPixels;
    const double meters = x_height * defaults.width / PanelInRoom::kPixels.x;
    const double degrees = std::atan(meters / defaults.distance) * 57.29578;
    EXPECT_GT(degrees, 0.6);
    EXPECT_LT(degrees, 1.2) << "beyond that little fits on it";
}

/// A wand before the sphere, pointing at its middle.
class PickTest : public RoomPanelTest {
  protected:
    PickTest() {
        Config config = panel_config(kWindow);
        config.start.room_panel.shown = false;
        session_.emplace(config, file_, *context_);
        settle(*session_, {}, std::nullopt);
    }
    InputState pointing(std::uint64_t buttons, const glm::dvec3& at_voxel) {
        InputState state = input();
        const glm::vec3 hand(0.22f, 1.2f, -0.3f);
        const glm::vec3 target(
            interaction::transform(session_->state().room_from_physical, at_voxel));
        interaction::DeviceState wand;
        wand.name = "wand";
        wand.pose = Pose{hand, glm::quatLookAt(glm::normalize(target - hand), glm::vec3(0, 1, 0))};
        wand.buttons = buttons;
        state.devices.push_back(wand);
        return state;
    }
    /// The pixels of the mark's color, which nothing else has.
    /// @param only_at this pixel, instead of all
    static std::vector<glm::ivec2> pink_pixels(const Image& image,
                                               const std::optional<glm::ivec2>& only_at = {}) {
        std::vector<glm::ivec2> found;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const std::uint8_t* pixel = image.at(x, y);
                if (pixel[0] > pixel[1] + 60 && pixel[2] > pixel[1] + 60 &&
                    (!only_at || *only_at == glm::ivec2(x, y)))
                    found.emplace_back(x, y);
            }
        return found;
    }
    const glm::dvec3 center_{12.0, 15.5, 15.5}; ///< center of the sphere at step 0, voxels of 1 mm
    std::optional<Session> session_;
};

TEST_P(PickTest, MarksThePointOfTheSurfaceThatTheRayMeets) {
    WandSession wand(*session_, window_of);
    wand.frame(pointing(0, center_));
    wand.frame(pointing(bit(WandButton::pick), center_));
    wand.frame(pointing(bit(WandButton::pick), center_));
    const auto& mark = session_->state().mark.point;
    ASSERT_TRUE(mark);
    const InputState input = pointing(0, center_);
    const auto& from = input.devices.back().pose->position;
    const auto& placement = session_->state().room_from_physical;
    const glm::dvec3 hand = glm::dvec3(glm::inverse(interaction::matrix(placement)) *
                                       glm::dvec4(glm::dvec3(from), 1.0));
    const double radius = 16.0 - session_->state().isovalue();
    const glm::dvec3 expected = center_ + radius * glm::normalize(hand - center_);
    EXPECT_LT(glm::distance(mark->position, expected), 0.05) << "the sphere is trilinear";
    EXPECT_EQ(mark->value, session_->state().isovalue());
    EXPECT_EQ(mark->instant, index::Instant(0));
    const auto& frames = wand.recording().frames;
    EXPECT_TRUE(frames[1].from_panel.mark) << "recorded with what no device alone explains";
    EXPECT_EQ(frames[1].commands.haptics.size(), 1u);
    EXPECT_FALSE(frames[2].commands.mark) << "still held";

    // The cross and its read-out.
    const Image image = session_->outputs().display().read_eye(stereo::Eye::left);
    const PinholeEye eye(session_->outputs().display().window().viewports.front().screen,
                         *head_at_rest(0).devices.front().pose, stereo::Eye::left,
                         session_->state().eye_separation, {image.width, image.height});
    const auto at = eye.pixel_of(interaction::transform(placement, mark->position));
    ASSERT_TRUE(at);
    const std::vector<glm::ivec2> pink = pink_pixels(image);
    EXPECT_GT(pink.size(), 20u);
    for (const glm::ivec2 pixel : pink) {
        EXPECT_LT(std::abs(pixel.x - at->x), 120);
        EXPECT_LT(std::abs(pixel.y - at->y), 80);
    }
    EXPECT_EQ(pink_pixels(image, glm::ivec2(*at)).size(), 1u) << "the middle of the cross";

    // A panel before it hides it.
    Commands commands;
    const glm::vec3 eyes(0, 1.5f, 0), place(interaction::transform(placement, mark->position));
    commands.room_panel =
        interaction::RoomPanel{true, interaction::facing(glm::mix(eyes, place, 0.5f), eyes)};
    session_->frame(this->input(), commands, Waiting::for_cells);
    EXPECT_TRUE(pink_pixels(session_->outputs().display().read_eye(stereo::Eye::left)).empty());
    commands.room_panel->shown = false;
    session_->frame(this->input(), commands, Waiting::for_cells);
    EXPECT_FALSE(pink_pixels(session_->outputs().display().read_eye(stereo::Eye::left)).empty());

    wand.frame(pointing(0, {-100, 200, 0}));
    wand.frame(pointing(bit(WandButton::pick), {-100, 200, 0}));
    EXPECT_FALSE(session_->state().mark.point) << "nothing is there";
    EXPECT_TRUE(wand.recording().frames.back().commands.haptics.empty());
}

TEST_P(PickTest, ReadsTheDataAtTheWandsTip) {
    WandSession wand(*session_, window_of);
    InputState state = pointing(bit(WandButton::probe), center_);
    const glm::dvec3 tip = center_ + glm::dvec3(3.0, 2.0, -4.0);
    state.devices.back().pose->position =
        glm::vec3(interaction::transform(session_->state().room_from_physical, tip));
    for (int frame = 0; !session_->state().mark.point; ++frame) { // the reader has a thread
        ASSERT_LT(frame, 1'000'000);
        state.time += interaction::Seconds(1e-3);
        wand.frame(state);
    }
    const auto& mark = *session_->state().mark.point;
    EXPECT_LT(glm::distance(mark.position, tip), 1e-3);
    EXPECT_NEAR(mark.value, 16.0 - std::sqrt(29.0), 0.15) << "the sphere is trilinear";
    EXPECT_TRUE(wand.recording().frames.back().from_panel.mark);
    EXPECT_EQ(wand.recording().frames.back().commands.haptics.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Contexts, RoomPanelTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);
INSTANTIATE_TEST_SUITE_P(Contexts, PickTest,
                         testing::Values(stereo::ContextKind::egl, stereo::ContextKind::osmesa),
                         context_name);

} // namespace
} // namespace isochron::app
