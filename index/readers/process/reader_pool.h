// The pool of reader processes: one for each open file; idle ones are kept for the next files.
#pragma once

#include "index/readers/process/readable_places.h"
#include "index/readers/process/reader_process.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

/// Thread-safe. It must outlive the readers' users.
class ReaderPool {
  public:
    explicit ReaderPool(ReaderLimits limits = {}) : limits_(limits) {}

    /// How long readers that are taken from now on may be silent, see ReaderLimits.
    void set_patience(std::chrono::milliseconds patience);
    /// What is called from now on while a thread waits for a reader that is taken then.
    void call_while_waiting(WhileWaiting waiting) { waiting_ = waiting; }

    /// From now on readers that are taken can read this file and all that is in its folder; where
    /// it is a folder, all that is in it. Where it is a symbolic link, also what it leads to.
    void let_read(const std::filesystem::path& file);
    /// Lets readers read many files, so that readers that are taken later are started once for all.
    void let_read(std::span<const std::filesystem::path> files);
    /// Whether `let_read` has named the file, or a folder that it is in.
    bool may_read(const std::filesystem::path& file) const;

    /// A reader of a program that nobody else uses: the idle one that was given back last, or a new
    /// one. @throws Error when none can be started
    std::unique_ptr<ReaderProcess> take(const std::string& program);
    /// A new reader, which has seen no file.
    std::unique_ptr<ReaderProcess> take_new(const std::string& program) const;
    /// Number of readers that it has started. Each opens all places that it may read.
    std::size_t started() const { return started_; }
    /// Makes a reader idle. It must have no file open and no request without a reply.
    void give_back(std::unique_ptr<ReaderProcess> reader);

  private:
    mutable std::mutex mutex_;
    ReaderLimits limits_;
    std::atomic<WhileWaiting> waiting_ = nullptr;
    mutable std::atomic<std::size_t> started_ = 0;
    ReadablePlaces readable_;
    std::vector<std::unique_ptr<ReaderProcess>> idle_;
};

/// The pool that `open_series` uses. There is one for the whole process, since starting a reader
/// takes many times as long as opening a small file.
ReaderPool& readers_of_this_process();

} // namespace isochron::index
