// Saves a session at intervals, when its user wants it, and at its end.
#include "app/loop/session_keeper.h"

#include "app/kept/earlier_sessions.h"
#include "app/kept/session_picture.h"
#include "app/text.h"
#include "interaction/navigation/key_frames.h"
#include "render/gl/gl.h"

#include <fmt/format.h>

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

} // namespace

void SessionKeeper::write(const fs::path& path, SavedSession session,
                          const std::shared_ptr<const render::Image>& seen, Others& others) {
    std::error_code error; // save_session reports a folder that cannot be made
    fs::create_directories(path.parent_path(), error);
    if (others.moves_earlier && fs::is_regular_file(path, error))
        others.moved = keep_earlier(path);
    if (seen)
        session.picture = png_of(made_small(*seen));
    save_session(path, session);
    others.moves_earlier = false;
    drop_sessions(std::exchange(others.drops, {}));
}

SessionKeeper::SessionKeeper(fs::path path, SavedSession kept, bool resumed,
                             std::vector<fs::path> drops)
    : path_(std::move(path)), start_(std::move(kept)), kept_(start_), name_(start_.name),
      others_(std::make_shared<Others>(Others{!resumed, {}, std::move(drops)})),
      head_(start_.head) {}

void SessionKeeper::after_frame(Session& session, const LiveFrame& frame) {
    head_ = frame.head;
    look_at(session, frame.drawn);
    if (const auto other = session.panel().take_continued())
        go_on_with(*other, session.state(), head_, session.left_arrays());
    const auto name = session.panel().take_session_name();
    if (name)
        set_name(*name);
    // Whoever saves from elsewhere cannot answer in the window.
    const bool asks = frame.commands.save && !frame.from_panel.save && name_.empty() &&
                      SessionPanel::is_flat(session.state()) && session.panel().ask_session_name();
    if (frame.commands.save || name)
        save_now(session.state(), head_, session.left_arrays(), !asks);
    else if (is_due(frame.input.time))
        update(session.state(), head_, frame.input.time, session.left_arrays());
}

/// Takes the picture over once it is final, beside the panel.
void SessionKeeper::look_at(const Session& session, const FrameReport& drawn) {
    unseen_ |= drawn.redrawn;
    if (!unseen_ || !drawn.final || session.outputs().displays() == 0)
        return;
    unseen_ = false;
    try {
        const stereo::Display& display = session.outputs().display();
        const stereo::Eye eye = stereo::eyes_of(display.mode()).front();
        seen_ = std::make_shared<render::Image>(display.read_eye(eye));
    } catch (const render::Error&) { // nothing was drawn into that window
    }
}

void SessionKeeper::set_name(const std::string& name) {
    name_ = name;
    goes_on_with_.clear();
}

void SessionKeeper::go_on_with(const OfferedSession& other, const ExplorerState& state,
                               const interaction::StandingPlace& head, const Arrays& arrays) {
    const bool changed = keep(state, head, arrays) && !kept_.only_looked;
    writing_.post([path = path_, session = kept_, seen = seen_, others = others_, changed] {
        if (changed)
            write(path, session, seen, *others);
        others->moves_earlier = true;
        return std::string();
    });
    kept_.name.clear();
    name_ = other.name;
    goes_on_with_ = other.name.empty() ? fs::path() : other.file;
}

std::vector<std::string> SessionKeeper::finish(const Session& session) {
    finish(session.state(), head_, session.left_arrays());
    return {};
}

bool SessionKeeper::keep(const ExplorerState& state, const interaction::StandingPlace& head,
                         const Arrays& arrays) {
    interaction::Commands commands = interaction::kept_state(state.as_commands());
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
    writing_.post([path = path_, session = kept_, seen = seen_, others = others_] {
        write(path, session, seen, *others);
        return std::string();
    });
}

void SessionKeeper::save_now(const ExplorerState& state, const interaction::StandingPlace& head,
                             const Arrays& arrays, bool says) {
    keep(state, head, arrays);
    kept_.name = name_;
    writing_.post([path = path_, session = kept_, seen = seen_, others = others_,
                   replaced = std::exchange(goes_on_with_, {}), says] {
        write(path, session, seen, *others);
        std::error_code ignored;
        if (const fs::path& old = replaced == path ? others->moved : replaced; !old.empty())
            fs::remove(old, ignored);
        return !says ? std::string()
               : session.name.empty()
                   ? "session saved: " + whole_path(path)
                   : fmt::format("session saved as {}: {}", session.name, whole_path(path));
    });
}

void SessionKeeper::finish(const ExplorerState& state, const interaction::StandingPlace& head,
                           const Arrays& arrays) {
    writing_.finish();
    if (keep(state, head, arrays))
        write(path_, kept_, seen_, *others_);
}

} // namespace isochron::app
