// Watches whether an open index has grown.
#include "index/file/index_watch.h"

#include "index/file/index_states.h"

#include "index/system/descriptor.h"
#include "index/system/links/link_source.h"

#include <algorithm>

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

/// Opened first: network file systems ask their server then. @throws Error as `open_regular`
FileState asked_state(const std::filesystem::path& path) {
    const Descriptor opened(open_regular(path));
    return state_of(path);
}

/// Whether nothing can be written any more without another time: clocks of file systems go in steps,
/// of two seconds at most.
bool is_settled(const FileState& state) {
    constexpr std::chrono::nanoseconds kLongestStep = std::chrono::seconds(2);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return now - std::chrono::nanoseconds(state.written) > kLongestStep;
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

std::shared_ptr<const IndexFile> GrowthLook::look(const IndexFile& known) {
    if (const RemoteSource* const remote = remote_of(known.bytes()))
        try {
            return remote->may_have_changed() ? grown(path_, known) : nullptr;
        } catch (const std::exception&) { // the server cannot be reached, or the process ends
            return nullptr;
        }
    try {
        const FileState state = asked_state(path_);
        if (state == looked_at_)
            return nullptr;
        looked_at_.reset();
        if (is_settled(state))
            looked_at_ = state;
        return grown(path_, known);
    } catch (const Error&) { // it is being replaced
        looked_at_.reset();
        return nullptr;
    }
}

IndexWatch::IndexWatch(std::filesystem::path path, std::shared_ptr<const IndexFile> known,
                       std::function<void()> wake)
    : look_(std::move(path)), wake_(std::move(wake)), known_(std::move(known)),
      worker_([this](const std::stop_token& stop) { watch(stop); }) {}

IndexWatch::~IndexWatch() = default;

std::shared_ptr<const IndexFile> IndexWatch::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(newer_, nullptr);
}

void IndexWatch::watch(const std::stop_token& stop) {
    constexpr std::chrono::milliseconds kLongestOfServer{4000};
    const std::chrono::milliseconds longest =
        remote_of(known_->bytes()) ? kLongestOfServer : kLongest;
    std::chrono::milliseconds period = kPeriod;
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, stop, period, [&] { return stop.stop_requested(); })) {
        const std::shared_ptr<const IndexFile> known = known_;
        lock.unlock();
        auto found = look_.look(*known);
        lock.lock();
        period = found ? kPeriod : std::min(2 * period, longest);
        if (!found)
            continue;
        known_ = newer_ = std::move(found);
        if (wake_)
            wake_();
    }
}

} // namespace isochron::index
