// Ends the process soon after a signal, whatever its threads do: a driver may draw, and a disk may
// stall, for longer than anybody waits. The program allows it, work that hears signals begins to watch,
// and the handler of signals says when one has come.
#pragma once

#include <chrono>
#include <functional>

namespace isochron::app {

class EndInTime {
  public:
    /// Work that hears of a signal may end by itself for so long.
    static constexpr std::chrono::milliseconds kByItself{200};
    /// What `SavedAtEnd` saves may take so long; then it is given up.
    static constexpr std::chrono::seconds kToSave{5};
    static constexpr std::chrono::seconds kToCleanUp{1}; ///< likewise, without anything to save

    /// From now on `watch` has an effect. @param program its name, for `NAME: canceled`
    static void allow(const char* program);
    /// The process is one of several, which end together in their own way.
    static void leave_to_the_job();
    /// Begins to wait for `signaled`, on a thread of its own.
    static void watch();
    /// Safe in a signal handler.
    static void signaled(int signal) noexcept;
    /// Whether the caller is the one that says why the process ends: the first to ask.
    static bool is_first_to_tell();
};

/// While it lives, its function is called before the process is ended. The thread that makes it
/// changes what is saved only while it does not draw. One at a time.
class SavedAtEnd {
  public:
    /// @param save is called once, on another thread, must not draw, and throws nothing
    explicit SavedAtEnd(std::function<void()> save);
    ~SavedAtEnd();
    SavedAtEnd(const SavedAtEnd&) = delete;
    SavedAtEnd& operator=(const SavedAtEnd&) = delete;
};

/// While it lives, the thread of a `SavedAtEnd` draws, and changes nothing that is saved: the
/// process may be ended meanwhile. One may live within another; without a `SavedAtEnd` it does
/// nothing.
class DrawsOnly {
  public:
    DrawsOnly();
    ~DrawsOnly();
    DrawsOnly(const DrawsOnly&) = delete;
    DrawsOnly& operator=(const DrawsOnly&) = delete;
};

} // namespace isochron::app
