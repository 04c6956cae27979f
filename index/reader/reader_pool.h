// The pool of reader processes: one for each open file; idle ones are kept for the next files.
#pragma once

#include "index/reader/reader_process.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace isochron::index {

/// Thread-safe. It must outlive the readers' users.
class ReaderPool {
  public:
    explicit ReaderPool(ReaderLimits limits = {}) : limits_(limits) {}

    const ReaderLimits& limits() const { return limits_; }

    /// A reader of a program that nobody else uses: the idle one that was given back last, or a new
    /// one. @throws Error when none can be started
    std::unique_ptr<ReaderProcess> take(const std::string& program);
    /// A new reader, which has seen no file.
    std::unique_ptr<ReaderProcess> take_new(const std::string& program) const;
    /// Makes a reader idle. It must have no file open and no request without a reply.
    void give_back(std::unique_ptr<ReaderProcess> reader);

  private:
    ReaderLimits limits_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<ReaderProcess>> idle_;
};

/// The pool that `open_series` uses. There is one for the whole process, since starting a reader
/// takes many times as long as opening a small file.
ReaderPool& readers_of_this_process();

} // namespace isochron::index
