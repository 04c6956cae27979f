// An exploration: from the options of `explore` to a session that runs, and to what is shown next.
//
//     run_in_cluster([&](ClusterJob& job) { explore(options, job); });
#pragma once

#include "app/command_line/cancel.h"
#include "app/explore/cluster_job.h"
#include "app/explore/explore_options.h"
#include "app/explore/link_view.h"
#include "app/indexing/indexing.h"
#include "app/kept/earlier_sessions.h"
#include "app/kept/session_claim.h"
#include "app/kept/session_file.h"
#include "app/kept/user_memory.h"
#include "app/loop/live_loop.h"
#include "app/loop/session_control.h"
#include "stereo/headset.h"
#include "stereo/windows.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Shows what the options name, or the user chooses, and then what the user opens next, until the
/// user leaves. @throws index::Error, UsageError and so on: nothing can be shown
void explore(const ExploreOptions& options, ClusterJob& job);

/// The data that one session shows, with its devices, windows and index.
class Exploration {
  public:
    /// Opens all of it in every process of the job. @throws as `explore`
    Exploration(ExploreOptions options, ClusterJob& job);

    /// Runs the session until its user leaves, at once if they left before there was anything to
    /// see. @return other data that they want to see
    std::optional<NextData> run();
    /// The array that the user has chosen of files with several shapes; empty: there was no choice.
    std::optional<std::string> array() const;
    /// The user has given the data up by Escape before there was anything to see.
    bool canceled() const { return canceled_; }
    /// Shows a message in the session. @param message empty: none
    void say(const std::string& message);

  private:
    void open_data();
    void open_index_file();
    void open_outputs();
    std::string short_name() const;
    bool tells() const;
    bool may_prepare_later() const;
    std::unique_ptr<stereo::GlContext> context_beside() const;
    bool prepare_session();
    void open_session();
    void set_start();
    void tell_story();
    LinkScreen link_screen() const;

    LiveOptions live_options_with(UserMemory& memory, BackgroundWork& writing);
    void lead(LiveLoop& live, BackgroundWork& reading);
    std::vector<std::filesystem::path> offer_earlier(BackgroundWork& reading);
    void show_models();
    void say_dropped(const EarlierSession& session);
    void keep(LiveLoop& live, BackgroundWork& reading);
    void finish(LiveLoop& live, UserMemory& memory);
    void save(LiveLoop& live);

    /// A signal ends the session as its user would: the recording gets its final name.
    CancelOnSignal signals_;
    ExploreOptions options_;
    ClusterJob& job_;
    Config config_;
    std::shared_ptr<const index::IndexFile> file_; ///< null: the user left before it was there
    interaction::CompositeInput trackers_;
    std::unique_ptr<Indexing> indexing_; ///< index of these data, while they are shown and indexed
    std::unique_ptr<stereo::Headset> headset_;
    std::optional<stereo::Windows> windows_;
    std::optional<Session> session_;
    std::shared_ptr<SessionControl> control_; ///< null: nobody steers from outside
    bool canceled_ = false;
    std::vector<interaction::WindowEvent> early_; ///< events that came before the first frame
    std::map<std::string, std::string> of_link_;  ///< settings that came with the data's link
    std::optional<SavedSession> earlier_;         ///< the session that is resumed
    std::optional<SessionClaim> claim_;           ///< on the file to which this one is saved
};

} // namespace isochron::app
