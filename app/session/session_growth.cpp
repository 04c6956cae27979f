// A session goes on with data that grow.
#include "app/session/session.h"

#include "index/file/index_watch.h"

#include <utility>

namespace isochron::app {

void Session::grow(std::shared_ptr<const index::IndexFile> file) {
    file_ = std::move(file);
    newest_->set(file_);
    picker_.set_file(file_);
    extractor_.forget(); // colors run over all times, and over all values of the second array
}

/// In a cluster the first process tells that there are more steps, and the others look for them.
void Session::grow_with(const interaction::Commands& commands) {
    if (!commands.steps || *commands.steps <= file_->info().steps())
        return;
    if (auto file = index::grown(file_->name(), *file_))
        grow(std::move(file));
}

} // namespace isochron::app
