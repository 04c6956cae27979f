// The recording of a session that goes on.
#pragma once

#include "app/frame/background_work.h"
#include "interaction/recording/recording.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

/// Writes frames in the background, so that a slow disk delays no picture.
class LiveRecording {
  public:
    /// Records all further frames to a file. @throws interaction::Error when it cannot be created
    void begin(const std::filesystem::path& path, const interaction::RecordingHeader& header);
    /// Completes the file in the background, and says so then.
    void end();
    /// Whether a file is open, even if a frame could not be written to it.
    bool is_open() const { return recorder_ != nullptr; }
    /// Whether frames are recorded: no longer once one could not be written.
    bool records() const { return recorder_ && !lost_->load(); }

    void append(interaction::RecordedFrame frame);
    /// Nothing more may come for a long time: the frames that were appended reach the operating
    /// system now, so that a crash does not lose the last of them.
    void rest();

    /// Writes all of it so far to a file, as a complete recording. For movies, which call it on the
    /// thread of `work`. @throws interaction::Error when that cannot be written
    using Copy = std::function<void(const std::filesystem::path&)>;
    Copy copy() const;
    BackgroundWork& work() { return work_; }

    /// Sets the function that is called, on another thread, when there is a message.
    void set_wake(std::function<void()> wake) { work_.set_wake(std::move(wake)); }
    /// What became of the recording since the last call, for the user.
    std::vector<std::string> messages() { return work_.messages(); }
    /// Completes the file, if one is open. @throws interaction::Error, index::Error when it cannot
    /// be written
    void finish();

  private:
    BackgroundWork work_;
    /// Used only on the thread of `work_`.
    std::shared_ptr<interaction::RecordingWriter> recorder_;
    const std::shared_ptr<std::atomic<bool>> lost_ = std::make_shared<std::atomic<bool>>(false);
    bool rests_ = true; ///< since the last frame
};

} // namespace isochron::app
