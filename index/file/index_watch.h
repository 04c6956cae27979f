// Watches whether an open index has grown.
#pragma once

#include "index/file/index_file.h"
#include "index/system/input_file.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace isochron::index {

/// Opens the index again if it now has more steps than `known`, the same arrays, and begins with
/// the steps of `known`; else, or if it cannot be read at the moment, null.
std::shared_ptr<const IndexFile> grown(const std::filesystem::path& path, const IndexFile& known);

/// Looks again and again whether an index has grown, and reads it only where its file has changed
/// since the last look.
class GrowthLook {
  public:
    explicit GrowthLook(std::filesystem::path path) : path_(std::move(path)) {}
    /// Looks like `grown`.
    std::shared_ptr<const IndexFile> look(const IndexFile& known);

  private:
    std::filesystem::path path_;
    std::optional<FileState> looked_at_; ///< nothing was written to it since
};

/// Checks on a thread of its own: `kPeriod` after it has begun or the index has grown, then less and
/// less often down to every `kLongest`, as waking up takes processor time.
class IndexWatch {
  public:
    static constexpr std::chrono::milliseconds kPeriod{250}, kLongest{1000};

    /// @param wake called on its thread when the index has grown; may be null
    IndexWatch(std::filesystem::path path, std::shared_ptr<const IndexFile> known,
               std::function<void()> wake = {});
    ~IndexWatch();

    /// The grown index, returned once; else null. Never waits.
    std::shared_ptr<const IndexFile> take();

  private:
    void watch(const std::stop_token& stop);

    GrowthLook look_; ///< used by the thread alone
    std::function<void()> wake_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::shared_ptr<const IndexFile> known_, newer_;
    std::jthread worker_; ///< the last member: starts after, and is joined before, the others
};

} // namespace isochron::index
