// Steers a session from outside.
#include "app/loop/session_control.h"

#include <utility>

namespace isochron::app {

using interaction::Commands;

SessionControl::SessionControl(ControlAddress address, const Session& session,
                               ControlServerOptions options)
    : state_(std::make_shared<const ExplorerState>(session.state())) {
    desk_.set_file(session.file());
    desk_.show({.number = 0, .obeyed = 0, .state = state_, .report = {}});
    server_.emplace(std::move(address), desk_, std::move(options));
}

SessionControl::~SessionControl() = default;

Commands SessionControl::take(const Session& session) {
    const auto batch = desk_.take();
    if (!batch)
        return {};
    obeyed_ = batch->last;
    Commands commands = batch->commands;
    if (commands.undo || commands.redo) {
        const History& history = session.history();
        const Commands* const way = commands.undo ? history.undo() : history.redo();
        return way ? *way : Commands{};
    }
    if (commands.array) { // another array is shown as it was left, but for what is asked for
        const auto number = session.file()->array_called(*commands.array);
        Commands way = session.way_to_array(number.value_or(0));
        interaction::merge(way, commands);
        return way;
    }
    return commands;
}

void SessionControl::tell(Session& session, const FrameReport& frame) {
    if (!(*state_ == session.state()))
        state_ = std::make_shared<const ExplorerState>(session.state());
    give_pictures(session, frame);
    desk_.set_file(session.file()); // before clients are told of its new steps
    desk_.show({.number = ++frames_, .obeyed = obeyed_, .state = state_, .report = frame});
}

/// One picture answers all who wait for one of its kind. One that is not final, as motion does not
/// end, answers only those who have waited for so long.
void SessionControl::give_pictures(Session& session, const FrameReport& frame) {
    const PictureWishes wishes = desk_.wishes();
    if (wishes.final > given_.final && capture_.wanted() == 0) {
        capture_.ask();
        asked_ = wishes.final;
    }
    session.set_awaited(capture_.wanted() > 0);
    const CaptureView view = session.capture_view(frame);
    // A client that wants one picture after another slows no display.
    const bool is_due = frame.time >= next_picture_;
    const bool settled = is_due && capture_.take(view);
    if (settled)
        given_.final = view.is_final() ? wishes.final : asked_;
    if (settled || (is_due && wishes.now > given_.now)) {
        given_.now = wishes.now;
        next_picture_ = frame.time + kBetweenPictures;
        give_picture(session);
    }
    waits_ = given_.now < wishes.now || given_.final < wishes.final;
}

void SessionControl::give_picture(Session& session) {
    bool first = true; // only the first of several windows is given
    session.outputs().each_picture(
        session.note(), [&](const std::string&, render::Image image, const std::string& note) {
            if (std::exchange(first, false))
                desk_.give({std::move(image), note, given_});
        });
}

} // namespace isochron::app
