// Continues a session when its data have grown.
#include "app/session/session.h"

#include "index/file/index_watch.h"

#include <utility>

namespace isochron::app {

void Session::grow(std::shared_ptr<const index::IndexFile> file) {
    file_ = std::move(file);
    newest_->set(file_);
    picker_.set_file(array_of(file_, array_number()));
    extractor_.forget(); // color coordinates span all times, or all values of the second array
}

/// In a cluster rank 0 reports that there are more steps, and the other processes look for them.
void Session::grow_with(const interaction::Commands& commands) {
    if (!commands.steps || *commands.steps <= file_->info().steps())
        return;
    if (auto file = index::grown(file_->name(), *file_))
        grow(std::move(file));
}

} // namespace isochron::app
