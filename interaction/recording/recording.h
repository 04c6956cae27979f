// A session as a text file: JSON Lines, a header and then one record per frame.
#pragma once

#include "interaction/error.h"
#include "interaction/recording/recorded_frame.h"
#include "interaction/tracked_input.h"

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace isochron::interaction {

/// The file, line by line:
///
///     {"format":"isochron recording","version":1,"program":..,"configuration":..,"data":..,
///      "data_hash":..,"start":{commands}}
///     {"t":0.0,"devices":[{"name":"head","pose":[x,y,z,qx,qy,qz,qw]},..]}
///     {"t":0.016,"changed":[{"name":"keys","buttons":4096}],"commands":{"isovalue":112.5}}
///
/// `devices` states all devices, `changed` only those that differ from the frame before, and
/// neither means that all are as before. A device's `valid` (true), `buttons` (0) and `valuators`
/// ([]) are left out at these values, what a tracker adds (`lost`, `velocity` [v, w], `measured`,
/// `device_time`) where it has not been said; so are a frame's empty `commands` and `panel`, a
/// `footprint` that is as in the frame before, and `latched` ({"t":..,"devices":[..]}) where the
/// views were made of `devices`. Numbers round-trip.
struct Recording {
    RecordingHeader header;
    std::vector<RecordedFrame> frames;
    std::string note; ///< empty, or one line on an incomplete last line that was left out
};

/// Appends frame by frame to the temporary file `path` + `.part`; `finish` puts it in place. What
/// was written reaches the operating system at least once per second of session time, so that a
/// crash leaves a readable recording under the temporary name.
class RecordingWriter {
  public:
    /// @throws Error when the temporary file cannot be created
    RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header);
    ~RecordingWriter(); ///< finishes what was written if `finish` was not called
    /// @throws Error when the disk is full, time goes back or a number is not finite
    void append(const RecordedFrame& frame);
    /// Writes what was appended so far as a recording of its own.
    /// @throws Error when that cannot be written
    void copy_to(const std::filesystem::path& path);
    /// @throws Error when the file cannot be completed or renamed
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Writes all of it at once. @throws Error as the writer does
void write_recording(const std::filesystem::path& path, const Recording& recording);

/// Only a last line without line end that is cut short is forgiven, with a note.
/// @param name of the file, for messages
/// @throws Error naming file and line: not a recording, newer version, bad JSON, time going back,
/// ...
Recording read_recording(std::istream& file, const std::string& name);

/// Plays recorded device states: the newest frame not later than `now`, at first the first one.
class ReplayInput final : public TrackedInput {
  public:
    /// @param recording must outlive this
    explicit ReplayInput(const Recording& recording);
    InputState poll(Seconds now) override;
    /// Frames reached so far. A poll may pass several: the commands of all of them count.
    std::size_t frames_played() const;
    bool finished() const;

  private:
    const Recording& recording_;
    std::size_t next_ = 0;
};

} // namespace isochron::interaction
