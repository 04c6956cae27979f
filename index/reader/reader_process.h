// One running reader: a program beside this one in which a library decodes foreign files.
//
// VTK, HDF5 and their like crash on damaged files, and worse on hostile ones. In a process of their
// own that costs one line.
#pragma once

#include "index/error.h"
#include "index/reader/message_socket.h"
#include "index/reader/process_signs.h"
#include "index/reader/reader_messages.h"
#include "index/system/shared_memory.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <sys/types.h>

namespace isochron::index {

struct ReaderLimits {
    std::uint64_t memory = 0; ///< [bytes] that decoding a file may take; 0: what was free
    /// How long a reader may neither read nor touch new memory. Time in which it waits for a disk
    /// does not count, so that a slow one is no fault.
    std::chrono::milliseconds patience{60'000};
};

/// A reader is no longer there. The message says how it ended, of the file that was in it.
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
    /// Starts one, without waiting for it. @throws Error when there is none to start
    ReaderProcess(std::string program, ReaderLimits limits);
    ~ReaderProcess();
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    const std::string& program() const { return program_; }
    /// Files that it has been asked to open or to list.
    unsigned files() const { return files_; }

    /// Asks, without waiting. @throws ReaderEnded
    void ask(const ReaderRequest& request);
    /// The reply to what was asked first of what has not been replied to.
    /// @throws ReaderEnded also when it gets nowhere or says what no reader does: it is ended then
    ReaderReply reply();

    /// Memory of at least so many bytes, which the reader has, too. Its contents do not outlast the
    /// next call. @throws ReaderEnded
    std::span<std::byte> memory(std::size_t bytes);

  private:
    void send(const ReaderRequest& request, int attached = -1);
    ReaderReply next_reply();
    void watch();
    [[noreturn]] void fail(const std::string& why);
    [[noreturn]] void fail_as_it_ended();

    std::string program_;
    ReaderLimits limits_;
    pid_t process_ = -1;
    std::optional<MessageSocket> socket_;
    bool ready_ = false;
    unsigned files_ = 0;
    std::unique_ptr<SharedMemory> memory_;
    std::chrono::milliseconds silence_{0}; ///< since it last got anywhere
    std::optional<ProcessSigns> signs_;
};

} // namespace isochron::index
