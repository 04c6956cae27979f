// Steers a session from outside.
#include "app/session/session_control.h"

#include <utility>

namespace isochron::app {

using interaction::Commands;

SessionControl::SessionControl(ControlAddress address, const Session& session,
                               std::shared_ptr<const index::IndexFile> file,
                               ControlServerOptions options)
    : file_(std::move(file)), state_(std::make_shared<const ExplorerState>(session.state())) {
    desk_.set_file(file_);
    desk_.show({.number = 0, .obeyed = 0, .state = state_, .report = {}});
    server_.emplace(std::move(address), desk_, std::move(options));
}

SessionControl::~SessionControl() = default;

void SessionControl::set_file(std::shared_ptr<const index::IndexFile> file) {
    file_ = std::move(file);
    desk_.set_file(file_);
}

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
        const auto number = file_->array_called(*commands.array);
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
    desk_.show({.number = ++frames_, .obeyed = obeyed_, .state = state_, .report = frame});
}

/// One picture answers all who wait for one of its kind.
void SessionControl::give_pictures(Session& session, const FrameReport& frame) {
    const PictureWishes wishes = desk_.wishes();
    if (wishes.final > asked_.final && capture_.wanted() == 0)
        capture_.ask();
    asked_ = wishes;
    if (frame.time < next_picture_) { // a client that wants one after another slows no display
        waits_ = capture_.wanted() > 0 || wishes.now > given_.now;
        return;
    }
    const bool settled =
        capture_.wanted() > 0 && capture_.take({.time = frame.time,
                                                .asked = frame.asked,
                                                .shown = frame.shown,
                                                .failed = !session.failure().empty(),
                                                .final = frame.final});
    waits_ = capture_.wanted() > 0;
    if (!settled && wishes.now <= given_.now)
        return;
    next_picture_ = frame.time + kBetweenPictures;
    given_ = {wishes.now, settled ? wishes.final : given_.final};
    bool first = true; // of several windows the first one is given
    session.outputs().each_picture(
        session.note(), [&](const std::string&, render::Image image, const std::string& note) {
            if (std::exchange(first, false))
                desk_.give({std::move(image), note, given_});
        });
}

} // namespace isochron::app
