// The recording of a session that goes on.
#pragma once

#include "app/frame/background_work.h"
#include "app/loop/companion.h"
#include "interaction/recording/recording.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochron::app {

/// Writes frames in the background, so that a slow disk delays no picture.
class LiveRecording final : public Companion {
  public:
    /// Records all further frames to a file. @throws interaction::Error when it cannot be created
    void begin(const std::filesystem::path& path, const interaction::RecordingHeader& header);
    /// Completes the file in the background, and says so then.
    void end();
    /// Whether a file is open, even if a frame could not be written to it.
    bool is_open() const { return recorder_ != nullptr; }
    /// Whether frames are recorded: no longer once one could not be written.
    bool records() const { return recorder_ && !lost_->load(); }

    /// Appends the frame to the file that is open.
    void after_frame(Session& session, const LiveFrame& frame) override;
    /// The frames that were appended reach the operating system now, so that a crash does not lose
    /// the last of them.
    void rest() override;

    /// Writes all of it so far to a file, as a complete recording. For movies, which call it on the
    /// thread of `work`. @throws interaction::Error when that cannot be written
    using Copy = std::function<void(const std::filesystem::path&)>;
    Copy copy() const;
    BackgroundWork& work() { return work_; }

    void set_wake(std::function<void()> wake) override { work_.set_wake(std::move(wake)); }
    std::vector<std::string> messages() override { return work_.messages(); }
    /// Completes the file, if one is open.
    std::vector<std::string> finish(const Session& session) override;

  private:
    BackgroundWork work_;
    /// Used only on the thread of `work_`.
    std::shared_ptr<interaction::RecordingWriter> recorder_;
    std::filesystem::path path_; ///< path of the recording
    const std::shared_ptr<std::atomic<bool>> lost_ = std::make_shared<std::atomic<bool>>(false);
    bool rests_ = true; ///< since the last frame
};

} // namespace isochron::app
