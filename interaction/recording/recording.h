// A session as a text file: JSON Lines, a header and then one record per frame.
#pragma once

#include "interaction/error.h"
#include "interaction/input/tracked_input.h"
#include "interaction/recording/recorded_frame.h"

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace isochron::interaction {

/// The file, line by line:
///
///     {"format":"isochron recording","version":2,"program":..,"configuration":..,"data":..,
///      "data_hash":..,"start":{commands}}
///     {"t":0.0,"devices":[{"name":"head","pose":[x,y,z,qx,qy,qz,qw]},..]}
///     {"t":0.016,"changed":[{"name":"keys","actions":["play"]}],"commands":{"isovalue":112.5}}
///
/// `devices` lists all devices, `changed` only those that differ from the frame before; a frame
/// with neither has the devices of the frame before. Left out are: a device's `valid` if true,
/// `buttons` if 0, `actions` and `valuators` if empty, `lost` if false, and `velocity` ([v, w]),
/// `measured` and `device_time` if the tracker does not give them; a frame's `commands` and `panel`
/// if empty, `footprint` if it is the same as in the frame before, and `latched` ({"t":..,"devices":[..]}) if
/// the views were made from `devices`. Numbers round-trip. `actions` are those whose keys are down,
/// by their names in the table of actions (interaction/controls/action_table.h).
///
/// Version 1, which is read, too, kept actions as `buttons` of the devices `keys` and `more_keys`.
struct Recording {
    RecordingHeader header;
    std::vector<RecordedFrame> frames;
    std::string note; ///< empty, or one line that says that an incomplete last line was left out
};

/// Appends frames to the temporary file `path` + `.part`; `finish` renames it to `path`. Frames are
/// flushed to the operating system at least once per second of session time, so that a crash leaves
/// a readable recording under the temporary name.
class RecordingWriter {
  public:
    /// @throws Error when the temporary file cannot be created
    RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header);
    ~RecordingWriter(); ///< calls `finish` if it was not called; ignores its errors
    /// @throws Error when the disk is full, time goes back or a number is not finite
    void append(const RecordedFrame& frame);
    /// Hands everything appended so far to the operating system. @throws Error when the disk is full
    void flush();
    /// Writes everything appended so far to `path`, as a complete recording.
    /// @throws Error when that cannot be written
    void copy_to(const std::filesystem::path& path);
    /// @throws Error when the file cannot be completed or renamed
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Writes a whole recording. @throws Error as the writer does
void write_recording(const std::filesystem::path& path, const Recording& recording);

/// Reads a whole recording. If the last line is cut short and has no line end, it is left out and
/// noted; every other fault is an error.
/// @param name of the file, for messages
/// @throws Error naming file and line: not a recording, newer version, bad JSON, time going back,
/// ...
Recording read_recording(std::istream& file, const std::string& name);

/// Plays recorded device states: the newest frame not later than `now`, or else the first frame.
class ReplayInput final : public TrackedInput {
  public:
    /// @param recording must outlive this
    explicit ReplayInput(const Recording& recording);
    InputState poll(Seconds now) override;
    /// Number of frames reached so far. A poll may pass several; apply the commands of all of them.
    std::size_t frames_played() const;
    bool finished() const;

  private:
    const Recording& recording_;
    std::size_t next_ = 0;
};

} // namespace isochron::interaction
