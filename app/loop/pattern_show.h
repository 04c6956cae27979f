// The test pattern in every window of an installation: a session without data.
#pragma once

#include "app/cluster/frames_alone.h"
#include "app/config/config.h"
#include "app/frame/late_latch.h"
#include "app/output/outputs.h"
#include "app/scene/test_pattern.h"
#include "interaction/controls/controls.h"

#include <memory>
#include <span>

namespace isochron::app {

class PatternShow {
  public:
    /// @param windows of the configured installation
    /// @throws render::Error as Outputs
    PatternShow(Config config, stereo::Windows windows);

    /// Obeys those commands, from devices or a recording, that matter to the pattern.
    void obey(const interaction::Commands& commands);
    void set_stereo(stereo::StereoMode mode) { mode_ = mode; }
    stereo::StereoMode stereo() const { return mode_; }

    /// Commands from the devices: another stereo mode or eye separation, or the end.
    interaction::Commands commands_from(const interaction::InputState& input);

    /// Obeys the commands, then draws and presents every window.
    /// @param latch returns where the heads are when the views are made; empty: as in `input`
    void frame(const interaction::InputState& input, const interaction::Commands& commands = {},
               const Latch& latch = {});

    /// From now on the processes of a cluster show each frame together.
    void share_frames(std::unique_ptr<FrameSharing> sharing) { frames_ = std::move(sharing); }
    FrameSharing& frames() { return *frames_; }
    /// Whether a window of this or of another process is closed.
    bool should_close() const;

    Outputs& outputs() { return outputs_; } ///< the windows that show it

  private:
    void draw(const ScenePlace& place, std::span<const render::View> views);

    Config config_;
    Outputs outputs_;
    TestPattern pattern_;
    interaction::Controls controls_;
    stereo::StereoMode mode_;
    float eye_separation_;         ///< [m], of the first viewer
    interaction::InputState seen_; ///< in the last frame
    std::unique_ptr<FrameSharing> frames_ = std::make_unique<FramesAlone>();
};

} // namespace isochron::app
