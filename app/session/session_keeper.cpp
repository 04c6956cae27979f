// Saves a session at intervals and at its end.
#include "app/session/session_keeper.h"

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

bool SessionKeeper::changed(const ExplorerState& state,
                            const interaction::StandingPlace& head) const {
    return state.as_commands() != kept_.state || head != kept_.head;
}

void SessionKeeper::keep(const ExplorerState& state, const interaction::StandingPlace& head) {
    kept_.state = state.as_commands();
    kept_.head = head;
}

void SessionKeeper::update(const ExplorerState& state, const interaction::StandingPlace& head,
                           interaction::Seconds now) {
    if (now < next_)
        return;
    next_ = now + kInterval;
    if (!changed(state, head))
        return;
    keep(state, head);
    writing_.post([path = path_, session = kept_, moves = std::exchange(moves_earlier_, false)] {
        save(path, session, moves);
        return std::string();
    });
}

void SessionKeeper::finish(const ExplorerState& state, const interaction::StandingPlace& head) {
    writing_.finish();
    if (!changed(state, head))
        return;
    keep(state, head);
    save(path_, kept_, std::exchange(moves_earlier_, false));
}

} // namespace isochron::app
