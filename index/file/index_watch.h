// Whether an index that is open has grown meanwhile.
#pragma once

#include "index/file/index_file.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

namespace isochron::index {

/// The index under this name as it is now, where it holds more steps than `known`, those of `known`
/// first; else null, also where it cannot be read at the moment.
std::shared_ptr<const IndexFile> grown(const std::filesystem::path& path, const IndexFile& known);

/// Looks now and then, on a thread of its own.
class IndexWatch {
  public:
    static constexpr std::chrono::milliseconds kPeriod{250};

    IndexWatch(std::filesystem::path path, std::shared_ptr<const IndexFile> known);
    ~IndexWatch();

    /// What has grown, once; else null. Never waits.
    std::shared_ptr<const IndexFile> take();

  private:
    void watch(const std::stop_token& stop);

    std::filesystem::path path_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::shared_ptr<const IndexFile> known_, newer_;
    std::jthread worker_; ///< last: started when all else is ready, joined before it goes
};

} // namespace isochron::index
