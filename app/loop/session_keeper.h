// Saves a session while it runs, so that nothing is lost however it ends.
#pragma once

#include "app/frame/background_work.h"
#include "app/kept/session_file.h"
#include "app/loop/companion.h"
#include "interaction/pose.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

/// Writes in the background every 30 s, and at the end, if something has changed. An earlier
/// session under the same name that was not resumed gets a name with its date first.
class SessionKeeper final : public Companion {
  public:
    static constexpr interaction::Seconds kInterval{30.0};

    /// @param kept the session as it began, which needs no saving; `only_looked` of what it goes on
    /// with, else true
    /// @param resumed it was resumed from the file `path`, which may be replaced
    SessionKeeper(std::filesystem::path path, SavedSession kept, bool resumed);

    using Arrays = std::vector<interaction::Commands>; ///< as in `SavedSession`

    /// Whether `update` would look at the session now.
    bool is_due(interaction::Seconds now) const { return now >= next_; }
    void set_wake(std::function<void()> wake) override { writing_.set_wake(std::move(wake)); }
    /// Saves the session if the user asks for that, or if a save is due and it has changed.
    void after_frame(Session& session, const LiveFrame& frame) override;
    FrameOutlook outlook(interaction::Seconds) const override {
        return {.final = true, .until = next_};
    }
    std::vector<std::string> finish(const Session& session) override;

    /// Saves the session if a save is due and it has changed.
    void update(const ExplorerState& state, const interaction::StandingPlace& head,
                interaction::Seconds now, const Arrays& arrays = {});
    /// Saves the session now, and says where.
    void save_now(const ExplorerState& state, const interaction::StandingPlace& head,
                  const Arrays& arrays = {});
    /// Saves the session if it has changed since. @throws index::Error when it cannot be written
    void finish(const ExplorerState& state, const interaction::StandingPlace& head,
                const Arrays& arrays = {});

    const std::filesystem::path& path() const { return path_; }
    std::vector<std::string> messages() override { return writing_.messages(); }

  private:
    /// @return whether it differs from what was kept last
    bool keep(const ExplorerState& state, const interaction::StandingPlace& head,
              const Arrays& arrays);

    std::filesystem::path path_;
    const SavedSession start_;
    SavedSession kept_;
    /// An earlier session is to be renamed before the first save. Used where sessions are written.
    std::shared_ptr<bool> moves_earlier_;
    interaction::Seconds next_ = kInterval;
    interaction::StandingPlace head_; ///< in the last frame
    BackgroundWork writing_;
};

} // namespace isochron::app
