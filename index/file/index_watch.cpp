// Watches whether an open index has grown.
#include "index/file/index_watch.h"

#include "index/file/index_states.h"

#include "index/system/descriptor.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
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

/// What a file's system says of it without a byte being read. Opened first: network file systems ask
/// their server then.
struct FileState {
    dev_t device = 0;
    ino_t number = 0;
    off_t bytes = -1;
    timespec written{};

    static FileState of(const std::filesystem::path& path) {
        struct stat now {};
        const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
        if (!file || ::fstat(file.number(), &now) != 0)
            return {};
        return {now.st_dev, now.st_ino, now.st_size, now.st_mtim};
    }
    /// Nothing can have been written since without another time: clocks of file systems go in steps,
    /// of two seconds at most.
    bool is_settled() const {
        timespec now{};
        ::clock_gettime(CLOCK_REALTIME, &now);
        return bytes >= 0 && now.tv_sec - written.tv_sec > 2;
    }
    bool operator==(const FileState& other) const {
        return device == other.device && number == other.number && bytes == other.bytes &&
               written.tv_sec == other.written.tv_sec && written.tv_nsec == other.written.tv_nsec;
    }
};

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
    FileState looked_at; // settled, and without anything new
    std::chrono::milliseconds period = kPeriod;
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, stop, period, [&] { return stop.stop_requested(); })) {
        const std::shared_ptr<const IndexFile> known = known_;
        lock.unlock();
        const FileState state = FileState::of(path_);
        const bool is_settled = state.is_settled();
        auto found = is_settled && state == looked_at ? nullptr : grown(path_, *known);
        looked_at = is_settled ? state : FileState{};
        lock.lock();
        period = found ? kPeriod : std::min(2 * period, kLongest);
        if (!found)
            continue;
        known_ = newer_ = std::move(found);
        if (wake_)
            wake_();
    }
}

} // namespace isochron::index
