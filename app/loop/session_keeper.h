// Saves a session while it runs, so that nothing is lost however it ends.
#pragma once

#include "app/frame/background_work.h"
#include "app/kept/session_file.h"
#include "app/loop/companion.h"
#include "app/panel/panel_model.h"
#include "interaction/pose.h"
#include "render/gl/image.h"

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
    /// @param drops files of sessions that go once this one is saved, see `sessions_to_drop`
    SessionKeeper(std::filesystem::path path, SavedSession kept, bool resumed,
                  std::vector<std::filesystem::path> drops = {});

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
    /// Saves the session now, and says where unless `says` is false.
    void save_now(const ExplorerState& state, const interaction::StandingPlace& head,
                  const Arrays& arrays = {}, bool says = true);
    /// The session has this name from now on. @param name empty: none
    void set_name(const std::string& name);
    /// The user goes on with another session, so what was made before is kept apart. If the other one
    /// has a name, `save_now` saves under it, and removes its file.
    /// @param state, head, arrays before
    void go_on_with(const OfferedSession& other, const ExplorerState& state,
                    const interaction::StandingPlace& head, const Arrays& arrays = {});
    /// The picture of the session, which is made small when it is saved. @param seen not null
    void show(std::shared_ptr<const render::Image> seen) { seen_ = std::move(seen); }
    /// The name under which `save_now` saves; empty: none.
    const std::string& name() const { return name_; }
    /// Saves the session if it has changed since. @throws index::Error when it cannot be written
    void finish(const ExplorerState& state, const interaction::StandingPlace& head,
                const Arrays& arrays = {});

    const std::filesystem::path& path() const { return path_; }
    std::vector<std::string> messages() override { return writing_.messages(); }

  private:
    /// @return whether it differs from what was kept last
    bool keep(const ExplorerState& state, const interaction::StandingPlace& head,
              const Arrays& arrays);

    /// What is to be done with other files when the session is saved. Used where it is written.
    struct Others {
        bool moves_earlier = false;  ///< an earlier session is to be renamed first
        std::filesystem::path moved; ///< the name that it got; empty: none yet
        std::vector<std::filesystem::path> drops;
    };
    static void write(const std::filesystem::path& path, SavedSession session,
                      const std::shared_ptr<const render::Image>& seen, Others& others);
    void look_at(const Session& session, const FrameReport& drawn);

    std::filesystem::path path_;
    const SavedSession start_;
    SavedSession kept_;
    std::string name_;
    std::filesystem::path goes_on_with_; ///< file of the session with this name; empty: none
    const std::shared_ptr<Others> others_;
    std::shared_ptr<const render::Image> seen_; ///< what the user saw last; null: nothing yet
    bool unseen_ = false;                       ///< the picture has changed since
    interaction::Seconds next_ = kInterval;
    interaction::StandingPlace head_; ///< in the last frame
    BackgroundWork writing_;
};

} // namespace isochron::app
