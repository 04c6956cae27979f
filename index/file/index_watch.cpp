// Watches whether an open index has grown.
#include "index/file/index_watch.h"

#include "index/file/index_states.h"

#include <utility>

namespace isochron::index {
namespace {

bool has_arrays_of(const IndexFile& file, const IndexFile& known) {
    if (file.arrays() != known.arrays() || (file.color() == nullptr) != (known.color() == nullptr))
        return false;
    for (std::size_t number = 0; number < file.arrays(); ++number)
        if (file.array(number).info().array != known.array(number).info().array)
            return false;
    return true;
}

} // namespace

std::shared_ptr<const IndexFile> grown(const std::filesystem::path& path, const IndexFile& known) {
    try {
        const FileHeader now = checked_header(*open_bytes(path));
        if (now.content_hash == known.content_hash())
            return nullptr;
        auto file = IndexFile::open(path, known.cache_bytes());
        return file->info().steps() > known.info().steps() && has_arrays_of(*file, known) &&
                       has_had(*file, known.content_hash(), known.info().steps())
                   ? file
                   : nullptr;
    } catch (const Error&) { // it is being replaced
        return nullptr;
    }
}

IndexWatch::IndexWatch(std::filesystem::path path, std::shared_ptr<const IndexFile> known,
                       std::function<void()> wake)
    : path_(std::move(path)), wake_(std::move(wake)), known_(std::move(known)),
      worker_([this](const std::stop_token& stop) { watch(stop); }) {}

IndexWatch::~IndexWatch() = default;

std::shared_ptr<const IndexFile> IndexWatch::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(newer_, nullptr);
}

void IndexWatch::watch(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, stop, kPeriod, [&] { return stop.stop_requested(); })) {
        const std::shared_ptr<const IndexFile> known = known_;
        lock.unlock();
        auto found = grown(path_, *known);
        lock.lock();
        if (!found)
            continue;
        known_ = newer_ = std::move(found);
        if (wake_)
            wake_();
    }
}

} // namespace isochron::index
