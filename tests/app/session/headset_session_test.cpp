// The whole picture in a headset: what each eye sees of a sphere, and at what distance.
#include "tests/support/drawing/golden_fixture.h"
#include "tests/support/eventually.h"
#include "tests/support/played_fixture.h"

#include <algorithm>

namespace isochron::app {
namespace {

using played::Happening;

constexpr glm::ivec2 kEye(144, 128);

/// A headset with canted eyes that see more outwards than inwards, worn by somebody who leans.
void put_on(played::PlayedHeadset& headset) {
    const glm::quat outwards = glm::angleAxis(0.09f, glm::vec3(0, 1, 0));
    headset.eyes[0] = {{{-0.032f, 0, 0}, outwards}, {-0.75f, 0.5f, 0.55f, -0.6f}, kEye};
    headset.eyes[1] = {
        {{0.032f, 0, 0}, glm::conjugate(outwards)}, {-0.5f, 0.75f, 0.55f, -0.6f}, kEye};
    headset.head = {{0.05f, 1.68f, 0.1f},
                    glm::angleAxis(0.12f, glm::normalize(glm::vec3(0.3f, 0.4f, 1)))};
}

/// The lines of sight of an eye, from nothing but its pose and its angles.
PinholeEye oracle_of(const played::SubmittedView& view) {
    const auto corner = [&](float x, float y) {
        return view.pose.position +
               view.pose.orientation * glm::vec3(std::tan(x), std::tan(y), -1.0f);
    };
    const stereo::Screen screen{corner(view.fov.left, view.fov.down),
                                corner(view.fov.left, view.fov.up),
                                corner(view.fov.right, view.fov.up)};
    return {screen, view.pose, Eye::center, 0, kEye};
}

class HeadsetSession : public testing::Test {
  protected:
    HeadsetSession() {
        stereo::use_played_runtime();
        headset().reset();
        put_on(headset());
        config_ = small_config();
        draw_as_in_software(config_);
        config_.quality.settled = Footprint::surface;
        config_.openxr.enabled = true;
        config_.openxr.options.windowless = true;
        config_.openxr.options.near_plane = config_.installation.near_plane;
        config_.openxr.options.far_plane = config_.installation.far_plane;
    }
    ~HeadsetSession() override {
        session_->outputs().headset()->leave();
        session_.reset();
        EXPECT_EQ(stereo::codes(), std::vector<std::string>());
    }
    played::PlayedHeadset& headset() { return played::played_headset(); }

    void start() {
        session_.emplace(config_, file_, *context_, index::Extract(), open_headset(config_.openxr));
    }
    const FrameReport& frame(const Commands& commands, Waiting waiting = Waiting::for_cells) {
        now_ += interaction::Seconds(0.0111);
        stereo::Headset& client = *session_->outputs().headset();
        client.update(now_);
        client.begin_frame(now_);
        return session_->frame(client.poll(now_), commands, waiting);
    }
    /// Until the picture is there and does not change any more.
    void settle(const Commands& commands) {
        frame(commands);
        for (int i = 0; i < 60; ++i)
            if (frame({}).final && !session_->log().frames().back().redrawn &&
                !headset().frames.back().views.empty())
                break;
    }

    TestFolder folder_;
    std::shared_ptr<const index::IndexFile> file_ = build_sphere(folder_.path());
    std::unique_ptr<stereo::GlContext> context_ =
        stereo::make_context(stereo::ContextKind::egl, {.size = {128, 96}});
    Config config_;
    std::optional<Session> session_;
    interaction::Seconds now_{0};
};

TEST_F(HeadsetSession, EachCantedEyeIsShownTheSphereWhereItStands) {
    start();
    settle(showing(kPlacement));
    const auto& views = headset().frames.back().views;
    ASSERT_EQ(views.size(), 2u);
    for (const Eye eye : {Eye::left, Eye::right}) {
        const std::string name = "headset_" + std::string(name_of(eye));
        SCOPED_TRACE(name);
        const played::SubmittedView& view = views[eye == Eye::right];
        EXPECT_TRUE(matches_golden(view.picture, name, tolerance_of(*context_)));
        EXPECT_EQ(view.picture.rgba, session_->outputs().headset_display()->read_eye(eye).rgba);
        const PinholeEye pinhole = oracle_of(view);
        expect_sphere(warm_part(view.picture), expected_part(pinhole, kPlacement, kOuterRadius),
                      0.0);
        EXPECT_GT(expect_box(view.picture, pinhole, kPlacement), 6 * kPerEdge);
    }
}

/// The depths of the runtime's layer are those of the sphere's front.
TEST_F(HeadsetSession, TheDepthLayerHoldsTheDistanceOfTheSurface) {
    start();
    Commands commands = showing(kPlacement);
    commands.bounding_box = false;
    settle(commands);
    const played::SubmittedView& view = headset().frames.back().views.at(0);
    ASSERT_EQ(view.depth.size(), std::size_t(kEye.x) * kEye.y);
    const glm::dvec3 center = in_room(kPlacement, kSphereCenter);
    const glm::dvec3 eye(view.pose.position);
    const auto pixel = oracle_of(view).pixel_of(center);
    ASSERT_TRUE(pixel);
    const double z = view.depth[std::size_t(pixel->y) * kEye.x + std::size_t(pixel->x)];
    const double n = view.near_z, f = view.far_z;
    const double along = n * f / (f - z * (f - n)); // meters in the eye's direction
    const glm::dvec3 ahead = glm::dquat(view.pose.orientation) * glm::dvec3(0, 0, -1);
    const glm::dvec3 front =
        center - kPlacement.scale * kOuterRadius * glm::normalize(center - eye);
    EXPECT_NEAR(along, glm::dot(front - eye, ahead), 0.01);
}

TEST_F(HeadsetSession, AStillPictureIsShownAgainWithoutBeingDrawnAgain) {
    start();
    settle(showing(kPlacement));
    const render::Image before = headset().frames.back().views.at(0).picture;
    EXPECT_FALSE(frame({}).redrawn);
    EXPECT_EQ(headset().frames.back().views.at(0).picture.rgba, before.rgba);
    headset().head.position.x += 0.2f;
    EXPECT_TRUE(frame({}).redrawn);
    EXPECT_EQ(headset().frames.back().views.at(0).picture.rgba,
              session_->outputs().headset_display()->read_eye(Eye::left).rgba);
    EXPECT_NE(headset().frames.back().views.at(0).picture.rgba, before.rgba);
}

TEST_F(HeadsetSession, ThatIsPutDownEndsAtTheExactPictureInPartsThatInputGivesUp) {
    config_.quality.frame_budget_ms = config_.quality.still_budget_ms =
        1e-6; // no frame can hold it
    start();
    settle(showing(kPlacement));
    const auto shown = [&] { return headset().frames.back().views.at(0).picture.rgba; };
    const auto exact = shown();
    const auto live = [&] { return frame({}, Waiting::never); };
    const auto rest_until = [&](const std::function<bool(const FrameReport&)>& wanted) {
        return test_support::eventually([&] {
            for (int i = 0; i < 50; ++i)
                if (wanted(live()))
                    return true;
            return false;
        });
    };
    const auto begun = [](const FrameReport& report) {
        return report.in_parts && report.footprint != *report.in_parts;
    };
    headset().head.position.x += 0.2f;
    EXPECT_NE(live().footprint, Footprint::surface);
    ASSERT_TRUE(rest_until(begun));
    EXPECT_NE(live().footprint, Footprint::surface) << "not whole yet";
    headset().head.position.x -= 0.2f;
    const FrameReport moved = live();
    EXPECT_TRUE(moved.redrawn && !moved.in_parts) << "given up";
    ASSERT_TRUE(rest_until(begun));
    const auto fast = shown();
    EXPECT_NE(fast, exact);
    const std::size_t first = headset().frames.size();
    ASSERT_TRUE(rest_until(&FrameReport::final));
    EXPECT_EQ(session_->log().frames().back().reason, QualityReason::in_parts);
    EXPECT_EQ(shown(), exact);
    EXPECT_GT(headset().frames.size(), first + 2);
    for (std::size_t i = first; i < headset().frames.size(); ++i) {
        ASSERT_EQ(headset().frames[i].views.size(), 2u) << "every frame has a picture";
        const auto& each = headset().frames[i].views[0].picture.rgba;
        EXPECT_TRUE(each == fast || each == exact) << "nothing in between is shown";
    }
}

TEST_F(HeadsetSession, ShowsAMomentBetweenStepsToBothEyesAsAStepWithItsValues) {
    const index::Instant at(2, 30'000);
    StepsAndABlend series(at);
    build_index(series, folder_.path() / "blend.isochron", {});
    Commands commands = showing(kPlacement);
    commands.bounding_box = false;
    commands.between = interaction::BetweenSteps::blend;
    commands.isovalue = 8.0;
    std::array<std::array<std::vector<std::uint8_t>, 2>, 2> seen; // by session and eye
    for (const bool as_step : {true, false}) {
        if (session_) {
            session_->outputs().headset()->leave();
            session_.reset();
        }
        if (as_step)
            file_ = index::IndexFile::open(folder_.path() / "blend.isochron");
        else
            file_ = index::IndexFile::open(folder_.path() / "sphere.isochron");
        commands.instant = as_step ? index::Instant(6) : at;
        start();
        settle(commands);
        EXPECT_EQ(session_->log().frames().back().shown->instant, as_step ? index::Instant(6) : at);
        for (const std::size_t eye : {0, 1})
            seen[as_step][eye] = headset().frames.back().views.at(eye).picture.rgba;
    }
    EXPECT_TRUE(seen[0][0] == seen[1][0]);
    EXPECT_TRUE(seen[0][1] == seen[1][1]);
    EXPECT_TRUE(seen[0][0] != seen[0][1]);
    // Every frame of time that plays has its moment, and both eyes show it.
    Commands play;
    play.playback = interaction::PlaybackState{.playing = true};
    std::vector<index::Instant> shown;
    const std::size_t first = headset().frames.size();
    frame(play);
    for (int i = 0; i < 20; ++i) {
        now_ += interaction::Seconds(0.0111);
        stereo::Headset& client = *session_->outputs().headset();
        client.update(now_);
        client.begin_frame(now_);
        const interaction::InputState input = client.poll(now_);
        session_->frame(input, session_->commands_from(input), Waiting::for_cells);
        shown.push_back(session_->log().frames().back().shown->instant);
    }
    EXPECT_GT(std::ranges::count_if(shown, &index::Instant::between), 15);
    EXPECT_TRUE(std::ranges::adjacent_find(shown) == shown.end());
    for (std::size_t i = first; i < headset().frames.size(); ++i)
        EXPECT_EQ(headset().frames[i].views.size(), 2u);
}

TEST_F(HeadsetSession, IsGivenItsExactLayerAgainForAMomentFromWhereItWasDrawn) {
    config_.quality.frame_budget_ms = config_.quality.still_budget_ms =
        1e-6; // no frame can hold it
    start();
    settle(showing(kPlacement));
    const auto live = [&] { return frame({}, Waiting::never); };
    ASSERT_TRUE(test_support::eventually([&] {
        const FrameReport report = live();
        return report.final && report.footprint == Footprint::surface;
    }));
    const played::SubmittedView exact = headset().frames.back().views.at(0);
    const auto shown = [&]() -> const played::SubmittedView& {
        return headset().frames.back().views.at(0);
    };
    headset().head.position.x += 0.01f;
    EXPECT_TRUE(live().moved);
    EXPECT_TRUE(shown().picture.rgba == exact.picture.rgba);
    EXPECT_EQ(shown().pose, exact.pose) << "the runtime moves it from there";
    for (int i = 0; i < 40; ++i) { // 0.44 s
        headset().head.position.x += 1e-4f;
        live();
    }
    EXPECT_FALSE(session_->log().frames().back().moved);
    EXPECT_NE(shown().pose, exact.pose);
    EXPECT_TRUE(shown().picture.rgba != exact.picture.rgba);
}

TEST_F(HeadsetSession, AStillPictureIsThereAgainAfterTheSessionWasLost) {
    start();
    settle(showing(kPlacement));
    const render::Image before = headset().frames.back().views.at(0).picture;
    headset().happens(Happening::lose_session);
    frame({});
    frame({});
    now_ += interaction::Seconds(2.5);
    settle({});
    EXPECT_EQ(headset().sessions, 2u);
    EXPECT_EQ(headset().frames.back().views.at(0).picture.rgba, before.rgba);
}

/// A window beside the headset: what is done while the headset is away is seen there.
class HeadsetBesideWindow : public HeadsetSession {
  protected:
    HeadsetBesideWindow() {
        config_.openxr.options.windowless = false;
        config_.openxr.options.binding = stereo::OpenXrBinding::egl; // as the context is
        config_.installation.windows.front().stereo = StereoMode::mono;
        config_.installation.windows.front().size = {128, 96};
    }
    void stand_for(double seconds) {
        for (const auto end = now_ + interaction::Seconds(seconds); now_ < end;)
            frame({});
    }
    Image shown() const { return session_->outputs().display().read_window(); }
};

TEST_F(HeadsetBesideWindow, TheWindowShowsTheSceneWhileTheHeadsetIsLost) {
    config_.openxr.options.retry = interaction::Seconds(1000);
    start();
    Commands commands = showing(kPlacement);
    commands.stereo = "mono";
    settle(commands);
    EXPECT_FALSE(session_->outputs().shows_windows());
    headset().happens(Happening::lose_session);
    stand_for(0.3);
    EXPECT_FALSE(session_->outputs().shows_windows()) << "a moment without pictures is none";
    stand_for(0.4);
    ASSERT_TRUE(session_->outputs().shows_windows());
    const Image before = shown();
    EXPECT_GT(warm_part(before).pixels, 50) << "the sphere is seen";
    // Commands have an effect that is seen.
    interaction::Similarity beside = kPlacement;
    beside.translation.x += 0.3;
    Commands move;
    move.room_from_physical = beside;
    EXPECT_TRUE(frame(move).redrawn);
    EXPECT_GT(warm_part(shown()).center.x, warm_part(before).center.x + 5);
    EXPECT_FALSE(frame({}).redrawn) << "and it is drawn once";
}

TEST_F(HeadsetBesideWindow, TheHeadsetHasThePictureAgainOnceItIsBack) {
    start();
    settle(showing(kPlacement));
    const render::Image before = headset().frames.back().views.at(0).picture;
    headset().happens(Happening::lose_session);
    stand_for(0.7);
    EXPECT_TRUE(session_->outputs().shows_windows());
    now_ += interaction::Seconds(2.5);
    settle({});
    EXPECT_FALSE(session_->outputs().shows_windows());
    EXPECT_EQ(headset().frames.back().views.at(0).picture.rgba, before.rgba);
}

TEST_F(HeadsetBesideWindow, ARuntimeThatStartsLaterIsTakenUp) {
    config_.openxr.fallback = WithoutRuntime::wait;
    headset().runtime_available = false;
    start();
    Commands commands = showing(kPlacement);
    commands.stereo = "mono";
    frame(commands);
    stand_for(0.2);
    ASSERT_TRUE(session_->outputs().shows_windows());
    EXPECT_GT(warm_part(shown()).pixels, 50) << "the sphere is seen";
    headset().runtime_available = true;
    stand_for(1.5);
    EXPECT_EQ(headset().sessions, 0u) << "not before retry_seconds";
    stand_for(1.0);
    settle({});
    EXPECT_EQ(headset().sessions, 1u);
    EXPECT_FALSE(session_->outputs().shows_windows());
    EXPECT_FALSE(headset().frames.back().views.empty());
}

TEST_F(HeadsetSession, MissedFramesAndBudgetFollowTheRuntimesPeriod) {
    start();
    settle(showing(kPlacement));
    const auto live = [&](double between) -> const FrameReport& {
        now_ += interaction::Seconds(between);
        stereo::Headset& client = *session_->outputs().headset();
        client.update(now_);
        const auto begun = client.begin_frame(now_);
        session_->set_headset_period(begun ? std::optional(begun->period) : std::nullopt);
        return session_->frame(client.poll(now_), {}, Waiting::never);
    };
    headset().period = 50'000'000;
    live(0.05);
    unsigned missed = 0;
    for (int i = 0; i < 20; ++i) {
        missed += live(0.05).missed;
        EXPECT_NEAR(session_->log().frames().back().promised.count(), 50.0, 0.1);
    }
    EXPECT_EQ(missed, 0u);
    EXPECT_EQ(live(0.15).missed, 2u);
    session_->set_headset_period(std::nullopt);
    EXPECT_EQ(session_
                  ->frame(session_->outputs().headset()->poll(now_ + interaction::Seconds(0.05)),
                          {}, Waiting::never)
                  .missed,
              static_cast<unsigned>(std::round(0.05 * config_.rendering.frame_rate_limit)) - 1)
        << "what is configured counts again";
}

TEST_F(HeadsetSession, TheMirrorCutsTheLeftEyeToTheWindow) {
    config_.openxr.mirror = stereo::Mirror::left;
    start();
    settle(showing(kPlacement));
    const Image window = session_->outputs().headset_display()->read_window();
    ASSERT_EQ(window.width, 128);
    ASSERT_EQ(window.height, 96);
    EXPECT_TRUE(matches_golden(window, "headset_mirror", tolerance_of(*context_)));
    // All of the eye's width shows, so the sphere is as much smaller as the window is; the filter
    // widens its rim by less than half a pixel.
    const Coverage in_window = warm_part(window);
    const Coverage in_eye = warm_part(headset().frames.back().views.at(0).picture);
    const double smaller = 128.0 / kEye.x;
    EXPECT_NEAR(in_window.pixels, in_eye.pixels * smaller * smaller, 0.04 * in_window.pixels);
    EXPECT_NEAR(in_window.center.x, in_eye.center.x * smaller, 0.7);
}

} // namespace
} // namespace isochron::app
