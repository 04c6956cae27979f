// The test pattern in every window of an installation: a session without data.
#pragma once

#include "app/config/config.h"
#include "app/frame/late_latch.h"
#include "app/output/displays.h"
#include "app/output/kept_pictures.h"
#include "app/output/room_view.h"
#include "app/scene/test_pattern.h"
#include "app/session/background_work.h"
#include "interaction/controls.h"

#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

class PatternShow {
  public:
    /// @param windows those of the configured installation
    PatternShow(Config config, stereo::Windows windows);

    /// Of the commands that devices lead to or a recording holds, those that matter to a pattern.
    void obey(const interaction::Commands& commands);
    void set_stereo(stereo::StereoMode mode) { mode_ = mode; }

    /// What the devices lead to: another stereo mode, wider eyes, the end.
    interaction::Commands commands_from(const interaction::InputState& input);

    /// Draws and presents every window. @param latch tells where the heads are now
    void frame(const interaction::InputState& input, const Latch& latch = {});

    const stereo::Windows& windows() const { return windows_; }
    const stereo::Display& display(std::size_t window = 0) const { return displays_[window]; }
    std::size_t displays() const { return displays_.size(); }
    /// The room of an emulated installation; null where its windows are real.
    const RoomView* room() const { return room_ ? &*room_ : nullptr; }

    /// The last frame's pictures, drawn once more to be kept.
    KeptPictures kept_pictures();
    /// Writes a picture under its name, in the background.
    void write_image(render::Image image, const std::filesystem::path& path);
    BackgroundWork& pictures() { return pictures_; }

  private:
    void draw(stereo::Display& display, std::size_t window);

    Config config_;
    stereo::Windows windows_;
    render::Gl gl_;
    std::deque<stereo::Display> displays_; ///< by window
    std::optional<RoomView> room_;
    TestPattern pattern_;
    interaction::Controls controls_;
    const std::vector<std::string> stereo_modes_;
    stereo::StereoMode mode_;
    float eye_separation_;         ///< [m], of the first viewer
    interaction::InputState seen_; ///< in the last frame
    std::vector<stereo::Viewpoint> viewers_;
    BackgroundWork pictures_;
};

} // namespace isochron::app
