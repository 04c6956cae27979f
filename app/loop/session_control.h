// Steers a session from outside: hands the commands of the control socket to the loop of frames, and shows
// its clients the frames.
#pragma once

#include "app/control/control_server.h"
#include "app/loop/companion.h"
#include "app/quality/capture_wait.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace isochron::app {

class SessionControl final : public Companion {
  public:
    static constexpr interaction::Seconds kBetweenPictures{0.1}; ///< at least

    /// @throws interaction::Error when nothing can listen at the address
    SessionControl(ControlAddress address, const Session& session, ControlServerOptions options);
    ~SessionControl() override;

    /// Where it listens, for people.
    std::string where() const { return server_->where(); }
    const ControlServer& server() const { return *server_; }
    void set_wake(std::function<void()> wake) override { desk_.set_loop_wake(std::move(wake)); }
    void before_frame(Session& session, const interaction::Commands&,
                      interaction::Commands& asked) override {
        const interaction::Commands told = take(session);
        session.models().allow_those_of(told); // its clients are programs of this user
        interaction::merge(asked, told);
    }
    void after_frame(Session& session, const LiveFrame& frame) override {
        tell(session, frame.drawn);
    }
    void save(const Session&) override { server_->withdraw(); }
    /// The next frame is due at once where a client waits for it.
    FrameOutlook outlook(interaction::Seconds) const override {
        return {.busy = waits_ || desk_.has_commands(), .final = true};
    }

    /// The commands for the next frame, as a recording holds them. Call it once a frame.
    interaction::Commands take(const Session& session);
    /// Shows the clients a frame, and draws the picture that they wait for.
    void tell(Session& session, const FrameReport& frame);

  private:
    void give_pictures(Session& session, const FrameReport& frame);
    void give_picture(Session& session);

    ControlDesk desk_;
    std::shared_ptr<const ExplorerState> state_; ///< as it was shown last
    std::uint64_t frames_ = 0, obeyed_ = 0;
    PictureWishes given_;
    std::uint64_t asked_ = 0; ///< the newest final picture that `capture_` has waited for
    CaptureWait capture_;
    interaction::Seconds next_picture_{0};
    bool waits_ = false;
    std::optional<ControlServer> server_; ///< last: its thread uses the desk
};

} // namespace isochron::app
