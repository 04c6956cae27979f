// Saves a session at intervals and at its end.
#include "app/session/kept/session_keeper.h"

#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

void save(const fs::path& path, const SavedSession& session, bool moves_earlier) {
    std::error_code error; // save_session reports a folder that cannot be made
    fs::create_directories(path.parent_path(), error);
    if (moves_earlier && fs::is_regular_file(path))
        fs::rename(path, path.string() + ".before", error);
    save_session(path, session);
}

} // namespace

SessionKeeper::SessionKeeper(fs::path path, SavedSession kept, bool resumed)
    : path_(std::move(path)), kept_(std::move(kept)), moves_earlier_(!resumed) {}

bool SessionKeeper::keep(const ExplorerState& state, const interaction::StandingPlace& head,
                         const Arrays& arrays) {
    interaction::Commands commands = state.as_commands();
    if (commands == kept_.state && head == kept_.head && arrays == kept_.arrays)
        return false;
    kept_.state = std::move(commands);
    kept_.head = head;
    kept_.arrays = arrays;
    return true;
}

void SessionKeeper::update(const ExplorerState& state, const interaction::StandingPlace& head,
                           interaction::Seconds now, const Arrays& arrays) {
    if (!is_due(now))
        return;
    next_ = now + kInterval;
    if (!keep(state, head, arrays))
        return;
    writing_.post([path = path_, session = kept_, moves = std::exchange(moves_earlier_, false)] {
        save(path, session, moves);
        return std::string();
    });
}

void SessionKeeper::save_now(const ExplorerState& state, const interaction::StandingPlace& head,
                             const Arrays& arrays) {
    keep(state, head, arrays);
    writing_.post([path = path_, session = kept_, moves = std::exchange(moves_earlier_, false)] {
        save(path, session, moves);
        return "session saved: " + path.string();
    });
}

void SessionKeeper::finish(const ExplorerState& state, const interaction::StandingPlace& head,
                           const Arrays& arrays) {
    writing_.finish();
    if (keep(state, head, arrays))
        save(path_, kept_, std::exchange(moves_earlier_, false));
}

} // namespace isochron::app
