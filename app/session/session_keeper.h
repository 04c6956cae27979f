// Saves a session while it goes on, so that nothing is lost when it ends, however it ends.
#pragma once

#include "app/frame/background_work.h"
#include "app/session/session_file.h"
#include "interaction/pose.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Writes in the background, every 30 s in which something has changed, and at the end. What an
/// earlier session left under the name, and this one did not resume, is kept beside it, as
/// `NAME.before`.
class SessionKeeper {
  public:
    static constexpr interaction::Seconds kInterval{30.0};

    /// @param kept what is not saved: the session as it began
    SessionKeeper(std::filesystem::path path, SavedSession kept, bool resumed);

    /// Once a frame.
    void update(const ExplorerState& state, const interaction::StandingPlace& head,
                interaction::Seconds now);
    /// Saves what has changed since. @throws index::Error when it cannot be written
    void finish(const ExplorerState& state, const interaction::StandingPlace& head);

    const std::filesystem::path& path() const { return path_; }
    /// Since the last call; for people.
    std::vector<std::string> messages() { return writing_.messages(); }

  private:
    bool changed(const ExplorerState& state, const interaction::StandingPlace& head) const;
    void keep(const ExplorerState& state, const interaction::StandingPlace& head);

    std::filesystem::path path_;
    SavedSession kept_;
    bool moves_earlier_; ///< aside, before the first save
    interaction::Seconds next_ = kInterval;
    BackgroundWork writing_;
};

} // namespace isochron::app
