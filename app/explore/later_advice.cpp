// Takes the advice on what is shown between two steps again, once all steps are indexed.
#include "app/explore/later_advice.h"

#include "app/explore/explore_start.h"

#include <string>
#include <utility>

namespace isochron::app {

using interaction::BetweenSteps;

LaterAdvice::LaterAdvice(std::function<bool(const Session&)> is_whole)
    : is_whole_(std::move(is_whole)),
      asking_([](const Question& array, const Asking&) { return Answer(advised_between(*array)); },
              [](const Question&, const std::string&, bool) { return Answer(); }) {}

void LaterAdvice::before_frame(Session& session, const interaction::Commands& by_user,
                               interaction::Commands& asked) {
    over_ = over_ || by_user.between;
    if (over_)
        return;
    if (!asked_ && is_whole_(session)) {
        const index::IndexFile& file = *session.file();
        asking_.ask(array_of(session.file(), file.array_called(session.state().array).value_or(0)));
        asked_ = true;
    }
    for (const Answer& advice : asking_.take()) {
        over_ = true;
        if (!advice || *advice == session.state().between)
            continue;
        asked.between = *advice;
        session.show_messages(
            {*advice == BetweenSteps::blend
                 ? "all steps are there: they blend into each other now (Ctrl + T)"
                 : "all steps are there: time jumps between them now (Ctrl + T)"});
    }
}

std::function<bool(const Session&)> is_whole(const Indexing& indexing) {
    return [&indexing](const Session& session) {
        const Indexing::State now = indexing.state();
        return now.done && now.failure.empty() && session.file()->info().steps() >= now.of;
    };
}

} // namespace isochron::app
