// The recording of a session that goes on.
#include "app/loop/live_recording.h"

#include "app/text.h"

#include <utility>

namespace isochron::app {

void LiveRecording::begin(const std::filesystem::path& path,
                          const interaction::RecordingHeader& header) {
    recorder_ = std::make_shared<interaction::RecordingWriter>(path, header);
    path_ = path;
    rests_ = true;
}

void LiveRecording::end() {
    work_.post([recorder = recorder_, path = path_] {
        recorder->finish();
        return "the recording is saved: " + whole_path(path);
    });
    recorder_.reset();
}

void LiveRecording::after_frame(Session& session, const LiveFrame& made) {
    session.set_recording(records());
    if (!records())
        return;
    rests_ = false;
    interaction::RecordedFrame frame{made.input, made.commands, made.from_panel,
                                     name_of(made.drawn.footprint), session.latched()};
    work_.post([recorder = recorder_, lost = lost_, frame = std::move(frame)] {
        try {
            recorder->append(frame);
        } catch (...) {
            *lost = true;
            throw;
        }
        return std::string();
    });
}

void LiveRecording::rest() {
    if (std::exchange(rests_, true) || !records())
        return;
    work_.post([recorder = recorder_, lost = lost_] {
        try {
            recorder->flush();
        } catch (...) {
            *lost = true;
            throw;
        }
        return std::string();
    });
}

LiveRecording::Copy LiveRecording::copy() const {
    return [recorder = recorder_](const std::filesystem::path& path) { recorder->copy_to(path); };
}

std::vector<std::string> LiveRecording::finish(const Session&) {
    work_.finish();
    if (recorder_)
        recorder_->finish();
    return {};
}

} // namespace isochron::app
