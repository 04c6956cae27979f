// The readers of this process: as many as files are open in them at a time, kept for the next files.
#pragma once

#include "index/reader/reader_process.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace isochron::index {

/// Thread-safe. It outlives what it gives.
class ReaderPool {
  public:
    explicit ReaderPool(ReaderLimits limits = {}) : limits_(limits) {}

    const ReaderLimits& limits() const { return limits_; }

    /// One of a program that nobody else uses: the one that was given back last, or a new one.
    /// @throws Error when none can be started
    std::unique_ptr<ReaderProcess> take(const std::string& program);
    /// One that has seen no file.
    std::unique_ptr<ReaderProcess> take_new(const std::string& program) const;
    /// For others to use; it has no file open, and owes no reply.
    void give_back(std::unique_ptr<ReaderProcess> reader);

  private:
    ReaderLimits limits_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<ReaderProcess>> idle_;
};

/// The pool that `open_series` uses. One for the whole process, since starting a reader takes many
/// times as long as opening a small file.
ReaderPool& readers_of_this_process();

} // namespace isochron::index
