// A session whose frames come by a clock of the test, with a head at rest or one that walks.
#pragma once

#include "tests/support/eventually.h"
#include "tests/support/session_fixture.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace isochron::app {

class SessionQuality : public SessionTest {
  protected:
    static constexpr double kRate = 60; ///< [Hz] of the frames' clock, which is the tests'
    static constexpr double kPlenty = 1e7, kNothing = 1e-6; // ms: any frame fits, none does

    Config config_with(double budget_ms) const {
        Config config = small_config();
        config.rendering.frame_rate_limit = kRate;
        config.quality.frame_budget_ms = budget_ms;
        config.quality.still_budget_ms = 0;
        return config;
    }
    /// No frame holds the surface, so that it comes in parts.
    Config config_in_parts() const {
        Config config = config_with(kNothing);
        config.quality.still_budget_ms = 500;
        return config;
    }
    static bool is_exact(const FrameReport& frame) {
        return frame.final && frame.footprint == render::Footprint::surface;
    }
    static std::vector<std::uint8_t> shown(const Session& session) {
        return session.outputs().display().read_window().rgba;
    }
    interaction::Seconds now() const { return waited_ + interaction::Seconds(frame_ / kRate); }

    /// Frames with a head at rest.
    FrameReport rest(Session& session, int frames, const interaction::Commands& first = {}) {
        FrameReport report;
        for (int i = 0; i < frames; ++i, ++frame_)
            report = session.frame(head_at_rest(now().count()),
                                   i == 0 ? first : interaction::Commands{}, Waiting::never);
        return report;
    }
    /// Frames with a head at rest until this holds, however long worker and GPU take for it.
    FrameReport rest_until(Session& session, const std::function<bool(const FrameReport&)>& holds) {
        FrameReport report;
        EXPECT_TRUE(test_support::eventually([&] { return holds(report = rest(session, 10)); }));
        return report;
    }
    /// Frames with a head that walks.
    FrameReport walk(Session& session, int frames, const interaction::Commands& first = {}) {
        FrameReport report;
        for (int i = 0; i < frames; ++i, ++frame_) {
            interaction::InputState input = head_at_rest(now().count());
            input.devices[0].pose->position.x = static_cast<float>(0.5 * now().count());
            report = session.frame(input, i == 0 ? first : interaction::Commands{}, Waiting::never);
        }
        return report;
    }
    /// Starts with cells on the screen. A session of some age has waited since its picture was final.
    void start(Session& session) {
        session.frame(head_at_rest(now().count()), {}, Waiting::for_cells);
        ++frame_;
        if (GetParam().age > interaction::Seconds(0))
            rest_until(session, [](const FrameReport& frame) { return frame.final; });
        waited_ += grow_old(session);
    }
    bool captured(Session& session) const {
        session.outputs().pictures().finish();
        return std::filesystem::exists(folder_.path() / "isochron_0001.png");
    }
    int frame_ = 0;
    interaction::Seconds waited_{0};
};

} // namespace isochron::app
