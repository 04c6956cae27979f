// What the thread of the control socket and the loop of frames hand each other. Neither waits for
// the other, and every list has a limit.
#pragma once

#include "app/frame/explorer_state.h"
#include "app/frame/frame_report.h"
#include "index/file/index_file.h"
#include "interaction/commands.h"
#include "render/gl/image.h"

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace isochron::app {

/// A frame as clients are told of it. Never changed once it is shown.
struct ShownFrame {
    std::uint64_t number = 0; ///< number of the frame, from 1; 0: none yet
    std::uint64_t obeyed = 0; ///< number of the newest request that it obeys
    std::shared_ptr<const ExplorerState> state;
    FrameReport report;
};

/// The requests for pictures so far, numbered from 1.
struct PictureWishes {
    std::uint64_t now = 0;   ///< newest that takes the next frame as it is
    std::uint64_t final = 0; ///< newest that waits for cells and their final quality
};

/// Commands for one frame.
struct ControlBatch {
    interaction::Commands commands;
    std::uint64_t last = 0;    ///< number of the newest request in it
    PictureWishes wishes = {}; ///< the newest that came behind it: no earlier frame answers them
};

struct ControlPicture {
    render::Image image;
    std::string note; ///< as in a file
    PictureWishes answers;
};

class ControlDesk {
  public:
    static constexpr std::size_t kMostBatches = 64;

    // For the socket's thread.

    /// Puts commands down for the next frame: with those that wait already, where their order makes
    /// no difference, else for a frame of their own.
    /// @return the request's number; 0: there is no room until a frame has taken some
    std::uint64_t post(const interaction::Commands& commands);
    /// @return the wish's number, in its kind
    std::uint64_t want_picture(bool now);
    std::shared_ptr<const ShownFrame> shown() const;
    /// Number of the first frame that obeyed a request; of the newest, if that is long ago.
    std::uint64_t frame_of(std::uint64_t request) const;
    std::shared_ptr<const ControlPicture> picture() const;
    std::shared_ptr<const index::IndexFile> file() const;
    /// Whether the socket's thread is to be woken by frames.
    void set_interested(bool interested) { interested_ = interested; }

    // For the loop of frames.

    /// The commands of the next frame; empty: none.
    std::optional<ControlBatch> take();
    bool has_commands() const;
    void show(ShownFrame frame);
    /// Without those that came behind commands which no frame has taken yet.
    PictureWishes wishes() const;
    void give(ControlPicture picture);
    void set_file(std::shared_ptr<const index::IndexFile> file);

    // For both, before the thread begins.

    /// Called when there is something for the loop, on the socket's thread.
    void set_loop_wake(std::function<void()> wake);
    /// Called when there is something for the socket's thread, on the loop's.
    void set_socket_wake(std::function<void()> wake) { socket_wake_ = std::move(wake); }

  private:
    struct FirstToObey {
        std::uint64_t request, frame;
    };
    void wake_loop();

    mutable std::mutex mutex_;
    std::deque<ControlBatch> batches_;
    std::uint64_t posted_ = 0;
    PictureWishes wished_; ///< all so far
    PictureWishes wishes_; ///< wishes for the next frame
    std::shared_ptr<const ShownFrame> shown_;
    std::deque<FirstToObey> first_to_obey_; ///< ascending
    std::shared_ptr<const ControlPicture> picture_;
    std::shared_ptr<const index::IndexFile> file_;
    std::atomic<bool> interested_{false};
    std::function<void()> loop_wake_, socket_wake_;
};

} // namespace isochron::app
