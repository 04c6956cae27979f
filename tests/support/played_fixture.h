// Fixture for tests with a headset that the test plays, on EGL without a window.
#pragma once

#include "tests/support/played_headset/played_headset.h"

#include "stereo/headset_display.h"
#include "stereo/openxr/openxr_headset.h"
#include "tests/support/paths.h"
#include "tests/support/test_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace isochron::stereo {

using interaction::Pose;
using interaction::Seconds;
using played::Happening;

/// Sets environment variables by which the real loader finds the played runtime.
inline void use_played_runtime() {
    setenv("XR_RUNTIME_JSON", (test_support::binary_root() + "/played_headset.json").c_str(), 1);
    unsetenv("ISOCHRON_PLAYED_HEADSET");
    unsetenv("XR_ENABLE_API_LAYERS");
}

inline std::vector<std::string> codes() {
    std::vector<std::string> all;
    for (const played::Violation& each : played::played_headset().violations)
        all.push_back(each.call + ": " + each.code + ": " + each.text);
    return all;
}

class PlayedTest : public testing::Test {
  protected:
    PlayedTest() {
        use_played_runtime();
        headset().reset();
        options_.windowless = true;
        options_.retry = Seconds(2);
    }
    ~PlayedTest() override {
        if (client_) {
            client_->leave();
            client_->detach();
        }
        client_.reset();
        EXPECT_THAT(codes(), testing::IsEmpty());
        EXPECT_EQ(gl_.GetError(), GLenum{GL_NO_ERROR});
    }

    played::PlayedHeadset& headset() { return played::played_headset(); }

    void connect() {
        client_ = open_headset(options_);
        client_->attach(*context_, gl_);
    }

    /// Makes one frame as the program does. @return whether anything was drawn
    bool frame() {
        now_ += Seconds(0.0111);
        client_->update(now_);
        begun_ = client_->begin_frame(now_);
        input_ = client_->poll(now_);
        eyes_ = client_->eyes();
        display_.draw(eyes_, [&](std::span<const render::View> views) {
            views_.assign(views.begin(), views.end());
            if (scene_)
                scene_(views);
        });
        display_.submit(*client_, eyes_, false);
        return !eyes_.empty();
    }
    /// Makes frames until the headset wants pictures, as after any start.
    void settle() {
        for (int i = 0; i < 10 && !frame(); ++i) {
        }
        for (int i = 0; i < 3; ++i)
            frame();
    }

    std::unique_ptr<GlContext> context_ = make_context(ContextKind::egl, {.size = {64, 48}});
    render::Gl gl_{context_->loader()};
    OpenXrOptions options_;
    std::unique_ptr<Headset> client_;
    HeadsetDisplay display_{
        gl_, *context_, *context_, Mirror::both, {.background = {0.2f, 0.4f, 0.6f}}};
    HeadsetDisplay::Scene scene_;
    Seconds now_{0};
    std::optional<HeadsetFrame> begun_;
    interaction::InputState input_;
    std::vector<HeadsetEye> eyes_;
    std::vector<render::View> views_;
};

} // namespace isochron::stereo
