// Saves a session at intervals and at its end.
#include "app/loop/session_keeper.h"

#include "app/kept/earlier_sessions.h"
#include "app/text.h"

#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// Whether nothing differs but where somebody looks from, at which time, and how it is drawn: all
/// else is work.
bool only_looks_differ(const interaction::Commands& start, interaction::Commands now) {
    const auto seen = [&](auto... member) { ((now.*member = start.*member), ...); };
    using Changes = interaction::SettingChanges;
    seen(&Changes::steps, &Changes::instant, &Changes::follow, &Changes::playback,
         &Changes::room_from_physical, &Changes::orthographic, &Changes::quality, &Changes::stereo,
         &Changes::eye_separation, &Changes::panel, &Changes::room_panel, &Changes::exporting,
         &Changes::leaving);
    return now == start;
}

void save(const fs::path& path, const SavedSession& session, bool& moves_earlier) {
    std::error_code error; // save_session reports a folder that cannot be made
    fs::create_directories(path.parent_path(), error);
    if (moves_earlier && fs::is_regular_file(path, error))
        keep_earlier(path);
    save_session(path, session);
    moves_earlier = false;
}

} // namespace

SessionKeeper::SessionKeeper(fs::path path, SavedSession kept, bool resumed)
    : path_(std::move(path)), start_(std::move(kept)), kept_(start_),
      moves_earlier_(std::make_shared<bool>(!resumed)), head_(start_.head) {}

void SessionKeeper::after_frame(Session& session, const LiveFrame& frame) {
    head_ = frame.head;
    if (frame.commands.save)
        save_now(session.state(), head_, session.left_arrays());
    else if (is_due(frame.input.time))
        update(session.state(), head_, frame.input.time, session.left_arrays());
}

std::vector<std::string> SessionKeeper::finish(const Session& session) {
    finish(session.state(), head_, session.left_arrays());
    return {};
}

bool SessionKeeper::keep(const ExplorerState& state, const interaction::StandingPlace& head,
                         const Arrays& arrays) {
    interaction::Commands commands = state.as_commands();
    if (commands == kept_.state && head == kept_.head && arrays == kept_.arrays)
        return false;
    kept_.state = std::move(commands);
    kept_.head = head;
    kept_.arrays = arrays;
    kept_.only_looked = start_.only_looked && arrays == start_.arrays &&
                        only_looks_differ(start_.state, kept_.state);
    return true;
}

void SessionKeeper::update(const ExplorerState& state, const interaction::StandingPlace& head,
                           interaction::Seconds now, const Arrays& arrays) {
    if (!is_due(now))
        return;
    next_ = now + kInterval;
    if (!keep(state, head, arrays))
        return;
    writing_.post([path = path_, session = kept_, moves = moves_earlier_] {
        save(path, session, *moves);
        return std::string();
    });
}

void SessionKeeper::save_now(const ExplorerState& state, const interaction::StandingPlace& head,
                             const Arrays& arrays) {
    keep(state, head, arrays);
    writing_.post([path = path_, session = kept_, moves = moves_earlier_] {
        save(path, session, *moves);
        return "session saved: " + whole_path(path);
    });
}

void SessionKeeper::finish(const ExplorerState& state, const interaction::StandingPlace& head,
                           const Arrays& arrays) {
    writing_.finish();
    if (keep(state, head, arrays))
        save(path_, kept_, *moves_earlier_);
}

} // namespace isochron::app
