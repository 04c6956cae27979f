// One reader process, in which a library decodes foreign files.
//
// VTK, HDF5 and similar libraries crash on damaged files, and hostile files can do worse. In a
// separate process that ends with an error message instead.
#pragma once

#include "index/error.h"
#include "index/readers/process/message_socket.h"
#include "index/readers/process/reader_budget.h"
#include "index/readers/process/reader_messages.h"
#include "index/readers/process/reader_watch.h"
#include "index/system/shared_memory.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include <sys/types.h>

namespace isochron::index {

struct ReaderLimits {
    std::uint64_t memory = 0; ///< [bytes] that decoding a file may take; 0: what was free
    /// How long a reader may neither read nor touch new memory; and, with a second more for each
    /// megabyte of its file, how long it may do nothing at all during one request. Time in which it
    /// waits for a disk does not count, so that a slow disk is no failure.
    std::chrono::milliseconds patience{60'000};
};

/// Called every 100 ms on the thread that waits for a reader; what it throws ends the wait, and the
/// reader. Null: nothing is called.
using WhileWaiting = void (*)();

/// A reader has ended. The message names the file that it had open and says how the reader ended.
class ReaderEnded : public Error {
  public:
    enum class How : std::uint8_t { by_itself, by_our_hand };
    ReaderEnded(const std::string& what, How how) : Error(what), how_(how) {}
    How how() const { return how_; }

  private:
    How how_;
};

/// Not thread-safe: one owner.
class ReaderProcess {
  public:
    /// Starts a reader, without waiting until it is ready.
    /// @param readable what its fence leaves readable, where the kernel has Landlock
    /// @param readable_age of these places, see ReadablePlaces
    /// @throws Error when it cannot be started
    ReaderProcess(std::string program, ReaderLimits limits, const LeftReadable& readable,
                  std::uint64_t readable_age, WhileWaiting waiting = nullptr);
    ~ReaderProcess();
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    const std::string& program() const { return program_; }
    std::uint64_t readable_age() const { return readable_age_; }
    /// Whether this process has started it. A fork of that process must not use it, nor end it: it
    /// shares the socket.
    bool is_ours() const;
    /// Whether it can still be asked something.
    bool answers() const { return process_ >= 0 && !killed_; }
    /// Number of files that it has been asked to open or to list.
    unsigned files() const { return files_; }

    /// Sends a request, without waiting for the reply. @throws ReaderEnded
    void ask(const ReaderRequest& request);
    /// Waits for the reply to the oldest request without one.
    /// @param stop ends the wait, and the reader
    /// @throws ReaderEnded also when the reader makes no progress or sends an invalid message; it
    ///         is killed then
    /// @throws Interrupted when stopped
    ReaderReply reply(const std::stop_token& stop = {});

    /// Shared memory of at least that many bytes, which the reader has, too. Its contents are lost
    /// at the next call. @throws ReaderEnded
    std::span<std::byte> memory(std::size_t bytes);

  private:
    void send(const ReaderRequest& request, int attached = -1);
    ReaderReply next_reply(const std::stop_token& stop);
    void limit(const ReaderRequest& request);
    void limit_after(const ReaderReply& reply);
    void look();
    void kill();
    [[noreturn]] void fail(const std::string& why);
    [[noreturn]] void fail_as_it_ended();

    std::string program_;
    ReaderLimits limits_;
    std::uint64_t readable_age_;
    pid_t process_ = -1, parent_;
    std::optional<MessageSocket> socket_;
    WhileWaiting waiting_;
    bool ready_ = false, killed_ = false;
    unsigned files_ = 0;
    std::unique_ptr<SharedMemory> memory_;
    std::optional<ReaderBudget> budget_; ///< for the file that was opened last
    ReaderWatch watch_;
};

} // namespace isochron::index
