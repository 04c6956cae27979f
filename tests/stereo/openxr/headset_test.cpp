// The life of a headset: it appears, shows pictures, disappears and comes back.
#include "tests/support/played_fixture.h"

#include "render/gl/viewport.h"

#include <glm/gtc/matrix_transform.hpp>

#include <openxr/openxr.h>

#include <cstring>

namespace isochron::stereo {
namespace {

using testing::HasSubstr;

/// What the fixture clears to: sRGB 0.2 0.4 0.6.
void expect_background(const render::Image& picture) {
    const std::uint8_t* pixel = picture.at(picture.width / 2, picture.height / 3);
    EXPECT_EQ(pixel[0], 51);
    EXPECT_EQ(pixel[1], 102);
    EXPECT_EQ(pixel[2], 153);
}

TEST_F(PlayedTest, ShowsWhatIsDrawnToBothEyesWithItsDepth) {
    connect();
    settle();
    const auto& views = headset().frames.back().views;
    ASSERT_EQ(views.size(), 2u);
    for (const played::SubmittedView& view : views) {
        ASSERT_EQ(view.picture.width, 96);
        expect_background(view.picture);
        ASSERT_EQ(view.depth.size(), 96u * 96u);
        EXPECT_EQ(view.depth[1234], 1.0f);
        EXPECT_EQ(view.near_z, options_.near_plane);
        EXPECT_EQ(view.far_z, options_.far_plane);
    }
}

TEST_F(PlayedTest, WithoutADepthLayerThereIsThePictureAlone) {
    headset().has_depth = false;
    connect();
    settle();
    EXPECT_TRUE(headset().frames.back().views.at(0).depth.empty());
    expect_background(headset().frames.back().views[0].picture);
}

TEST_F(PlayedTest, LightGoesOverWhereThereIsNoFormatForDisplayValues) {
    headset().formats = {GL_RGBA8, GL_RGBA16F};
    connect();
    settle();
    // 0.2 sRGB is 0.0331 of full light; half floats keep it, and the runtime is asked for bytes.
    EXPECT_NEAR(headset().frames.back().views.at(0).picture.at(40, 40)[0], 0.0331 * 255, 1.0);
}

TEST_F(PlayedTest, WithoutAnyUsefulFormatItSaysWhichThereAre) {
    headset().formats = {GL_RGBA8};
    client_ = open_headset(options_);
    try {
        client_->attach(*context_, gl_);
        FAIL() << "was attached";
    } catch (const render::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("expected pictures as GL_SRGB8_ALPHA8"));
        EXPECT_THAT(error.what(), HasSubstr("0x8058"));
    }
}

/// Each corner of an asymmetric, canted eye's picture, as a point of the room 3 m away.
TEST_F(PlayedTest, CantedAsymmetricEyesSeeTheirCornersInTheCorners) {
    const glm::quat outwards = glm::angleAxis(0.17f, glm::vec3(0, 1, 0));
    headset().eyes[0] = {
        {{-0.031f, 0.004f, 0.01f}, outwards}, {-1.1f, 0.7f, 0.8f, -0.95f}, {80, 96}};
    headset().eyes[1] = {
        {{0.033f, 0, 0.01f}, glm::conjugate(outwards)}, {-0.65f, 1.05f, 0.85f, -0.9f}, {88, 92}};
    headset().head = {{0.3f, 1.7f, -0.4f},
                      glm::angleAxis(0.6f, glm::normalize(glm::vec3(1, 2, 0.5f)))};
    connect();
    settle();
    ASSERT_GE(views_.size(), 2u);
    for (int i = 0; i < 2; ++i) {
        const played::Eye& eye = headset().eyes[i];
        const render::View& view = views_[views_.size() - 2 + i];
        EXPECT_EQ(view.size, eye.size);
        for (const float x : {eye.fov.left, eye.fov.right})
            for (const float y : {eye.fov.down, eye.fov.up}) {
                const glm::vec3 corner = 3.0f * glm::vec3(std::tan(x), std::tan(y), -1.0f);
                const glm::vec3 in_head = eye.in_head.position + eye.in_head.orientation * corner;
                const glm::vec3 in_room =
                    headset().head.position + headset().head.orientation * in_head;
                const glm::vec4 clip =
                    view.clip_from_eye * view.eye_from_room * glm::vec4(in_room, 1);
                EXPECT_NEAR(clip.x / clip.w, x == eye.fov.left ? -1 : 1, 1e-4);
                EXPECT_NEAR(clip.y / clip.w, y == eye.fov.down ? -1 : 1, 1e-4);
            }
    }
}

TEST_F(PlayedTest, WithoutAStageTheViewersPlaceStandsForWhereTheRuntimeWasCentered) {
    headset().has_stage = false;
    headset().head = headset().local_in_stage;
    headset().head.position.x += 0.25f;
    options_.local_in_room.position = {0.0f, 1.6f, 0.0f};
    connect();
    settle();
    const Pose head = input_.find("head")->pose.value();
    EXPECT_LT(glm::distance(head.position, glm::vec3(0.25f, 1.6f, 0.0f)), 1e-5f);
    EXPECT_LT(glm::distance(eyes_.at(1).pose.position, glm::vec3(0.25f + 0.032f, 1.6f, 0.0f)),
              1e-5f);
}

TEST_F(PlayedTest, AStageThatIsDemandedAndMissingIsAnError) {
    headset().has_stage = false;
    options_.space = OpenXrSpace::stage;
    client_ = open_headset(options_);
    EXPECT_THROW(client_->attach(*context_, gl_), render::Error);
}

TEST_F(PlayedTest, WhileAnotherProgramIsShownFramesGoOnWithoutPictures) {
    connect();
    settle();
    headset().happens(Happening::hide);
    for (int i = 0; i < 4; ++i)
        frame();
    EXPECT_TRUE(eyes_.empty());
    EXPECT_TRUE(begun_.has_value());
    EXPECT_TRUE(headset().frames.back().views.empty());
    headset().happens(Happening::show);
    settle();
    EXPECT_EQ(eyes_.size(), 2u);
}

TEST_F(PlayedTest, ItsUserEndsTheProgram) {
    connect();
    settle();
    headset().happens(Happening::exit);
    HeadsetState state{};
    for (int i = 0; i < 10 && state != HeadsetState::ended; ++i) {
        frame();
        state = client_->update(now_);
    }
    EXPECT_EQ(state, HeadsetState::ended);
}

TEST_F(PlayedTest, TheProgramLeavesWithTheRuntimesConsent) {
    connect();
    settle();
    client_->leave();
    EXPECT_EQ(client_->update(now_), HeadsetState::ended);
}

TEST_F(PlayedTest, ALostSessionComesBackWithItsHeadsetAndNotBeforeItsTime) {
    connect();
    settle();
    headset().connected = false;
    headset().happens(Happening::lose_session);
    frame();
    EXPECT_EQ(client_->update(now_), HeadsetState::absent);
    EXPECT_THAT(client_->description(), HasSubstr("gone"));
    now_ += Seconds(2.1);
    EXPECT_EQ(client_->update(now_), HeadsetState::absent);
    EXPECT_THAT(client_->description(), HasSubstr("no headset is connected"));
    headset().connected = true;
    now_ += Seconds(1.0);
    EXPECT_EQ(client_->update(now_), HeadsetState::absent) << "looked for every 2 s";
    EXPECT_EQ(headset().sessions, 1u);
    now_ += Seconds(1.1);
    settle();
    EXPECT_EQ(headset().sessions, 2u);
    EXPECT_EQ(headset().instances, 1u);
    expect_background(headset().frames.back().views.at(1).picture);
}

TEST_F(PlayedTest, ASessionLostInTheMiddleOfAFrameComesBack) {
    connect();
    settle();
    headset().happens(Happening::lose_at_once);
    frame();
    EXPECT_TRUE(eyes_.empty());
    EXPECT_FALSE(frame());
    now_ += Seconds(2.1);
    settle();
    EXPECT_EQ(headset().sessions, 2u);
    EXPECT_EQ(eyes_.size(), 2u);
}

TEST_F(PlayedTest, ALostRuntimeIsLookedForAndStartedAnew) {
    connect();
    settle();
    headset().runtime_available = false;
    headset().happens(Happening::lose_instance);
    frame();
    for (int i = 0; i < 3; ++i) {
        now_ += Seconds(2.1);
        EXPECT_EQ(client_->update(now_), HeadsetState::absent);
        EXPECT_THAT(client_->description(), HasSubstr("does not start"));
    }
    headset().runtime_available = true;
    now_ += Seconds(2.1);
    settle();
    EXPECT_EQ(headset().instances, 2u);
    EXPECT_EQ(eyes_.size(), 2u);
}

TEST_F(PlayedTest, AHeadsetThatIsNotThereYetIsWaitedFor) {
    headset().connected = false;
    connect();
    EXPECT_FALSE(frame());
    headset().connected = true;
    now_ += Seconds(2.1);
    settle();
    EXPECT_EQ(eyes_.size(), 2u);
}

TEST_F(PlayedTest, WithoutARuntimeItSaysWhereOneWasLookedFor) {
    setenv("XR_RUNTIME_JSON", "/nowhere/runtime.json", 1);
    try {
        open_headset(options_);
        FAIL() << "was opened";
    } catch (const render::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("XR_RUNTIME_JSON=/nowhere/runtime.json"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST_F(PlayedTest, ARuntimeWithoutTheBindingIsRefusedWithWhatItHas) {
    headset().has_egl = false;
    try {
        open_headset(options_);
        FAIL() << "was opened";
    } catch (const render::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("has no XR_MNDX_egl_enable"));
        EXPECT_THAT(error.what(), HasSubstr("it has XR_KHR_opengl_enable"));
    }
    // The loader keeps what a runtime offers until an instance goes.
    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    std::strcpy(info.applicationInfo.applicationName, "none");
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    XrInstance instance = XR_NULL_HANDLE;
    ASSERT_EQ(xrCreateInstance(&info, &instance), XR_SUCCESS);
    xrDestroyInstance(instance);
}

TEST_F(PlayedTest, NothingIsDrawnForEyesThatAreNowhere) {
    connect();
    settle();
    headset().head_valid = false;
    EXPECT_FALSE(frame());
    headset().head_valid = true;
    headset().head.position.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(frame());
    headset().head.position.x = 0;
    EXPECT_TRUE(frame());
}

TEST_F(PlayedTest, APictureThatIsShownAgainIsTheSame) {
    connect();
    settle();
    const render::Image before = headset().frames.back().views.at(0).picture;
    client_->update(now_);
    client_->begin_frame(now_);
    const auto eyes = client_->eyes();
    display_.submit(*client_, eyes, true);
    EXPECT_EQ(headset().frames.back().views.at(0).picture.rgba, before.rgba);
}

TEST_F(PlayedTest, TheTimeOfAPictureIsTheSessions) {
    for (const bool has_clock : {true, false}) {
        headset().has_clock = has_clock;
        connect();
        settle();
        const auto monotonic = [] {
            return std::chrono::steady_clock::now().time_since_epoch().count();
        };
        const std::int64_t before = monotonic();
        frame();
        const std::int64_t after = monotonic();
        const double seen = begun_->display_time.count();
        const std::int64_t display = headset().frames.back().display_time;
        if (has_clock) { // the runtime's clock is the monotonic one
            EXPECT_GE(seen, now_.count() + 1e-9 * static_cast<double>(display - after) - 1e-6);
            EXPECT_LE(seen, now_.count() + 1e-9 * static_cast<double>(display - before) + 1e-6);
        } else {
            EXPECT_GE(seen, now_.count() + begun_->period.count() - 1e-6);
            EXPECT_LE(seen, now_.count() + begun_->period.count() +
                                1e-9 * static_cast<double>(after - before));
        }
        EXPECT_NEAR(begun_->period.count(), 0.011111111, 1e-9);
        client_->leave();
        client_->detach();
        client_.reset();
    }
}

TEST_F(PlayedTest, TheMirrorShowsTheEyesThatItIsToShow) {
    scene_ = [&](std::span<const render::View> views) { // the left eye red, the right one green
        for (int i = 0; i < 2; ++i) {
            render::set_viewport(gl_, views[i]);
            gl_.ClearColor(i == 0 ? 1.0f : 0.0f, i == 0 ? 0.0f : 1.0f, 0, 1);
            gl_.Clear(GL_COLOR_BUFFER_BIT);
        }
    };
    connect();
    settle();
    display_.mirror({});
    const render::Image both = display_.read_window();
    EXPECT_EQ(both.width, 64);
    EXPECT_EQ(both.at(10, 20)[0], 255);
    EXPECT_EQ(both.at(50, 20)[1], 255);
    EXPECT_EQ(both.at(50, 20)[0], 0);
    for (const played::SubmittedView& view : headset().frames.back().views)
        EXPECT_NE(view.picture.at(5, 90)[0], view.picture.at(5, 90)[1]);
    EXPECT_EQ(headset().frames.back().views.at(0).picture.at(94, 2)[0], 255);
    EXPECT_EQ(display_.read_eye(Eye::right).at(3, 3)[1], 255);
}

} // namespace
} // namespace isochron::stereo
