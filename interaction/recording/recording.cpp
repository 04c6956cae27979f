// Writing and reading recordings, and playing them.
#include "interaction/recording/recording.h"

#include "interaction/recording/recording_json.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <istream>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

namespace isochron::interaction {
namespace {

using nlohmann::json;

constexpr Seconds kFlushInterval{1.0};
constexpr std::size_t kLongestLine = std::size_t{16} << 20; ///< [byte]
constexpr int kDeepest = 16;                                ///< nesting of a line
constexpr std::size_t kMostFrames = 4'000'000;              ///< 9 hours at 120 Hz
constexpr std::size_t kMostStates = 40'000'000;             ///< devices of all frames together
constexpr std::size_t kMostValuators = 200'000'000;         ///< valuators of all frames together

std::string system_message() {
    return std::strerror(errno);
}

std::string line_of(const json& value) {
    return value.dump(-1, ' ', false, json::error_handler_t::replace) + '\n';
}

json parse(const std::string& line) {
    const auto bounded = [](int depth, json::parse_event_t, json&) {
        if (depth > kDeepest)
            throw Error("nested deeper than {} levels", kDeepest);
        return true;
    };
    try {
        return json::parse(line, bounded);
    } catch (const json::parse_error& error) {
        throw Error("not JSON at column {}", error.byte);
    } catch (const json::out_of_range&) {
        throw Error("a number is out of range");
    }
}

/// Reads a file line by line; its error messages name the file and the line's number.
class LineReader {
  public:
    LineReader(std::istream& file, std::string name) : name_(std::move(name)), file_(file) {}
    /// Reads the next line. @return false at the end of the file
    bool next() {
        line_.clear();
        complete_ = false;
        ++number_;
        for (int character; (character = file_.get()) != EOF;) {
            if (character == '\n') {
                complete_ = true;
                return true;
            }
            line_.push_back(static_cast<char>(character));
            if (line_.size() > kLongestLine)
                throw Error(message(fmt::format("longer than {} bytes", kLongestLine)));
        }
        if (file_.bad())
            throw Error(message(system_message()));
        return !line_.empty();
    }
    const std::string& line() const { return line_; }
    bool complete() const { return complete_; } ///< the line ended before the file did
    std::string message(std::string_view what) const {
        return fmt::format("{}:{}: {}", name_, number_, what);
    }

  private:
    std::string name_;
    std::istream& file_;
    std::string line_;
    bool complete_ = false;
    std::size_t number_ = 0;
};

/// Limits the memory of the frames: a short file can state many devices by repeating them.
class Budget {
  public:
    void add(const RecordedFrame& frame) {
        for (const InputState* input : {&frame.input, &frame.latched}) {
            states_ += input->devices.size();
            for (const DeviceState& device : input->devices)
                valuators_ += device.valuators.size();
        }
        if (++frames_ > kMostFrames || states_ > kMostStates || valuators_ > kMostValuators)
            throw Error("too long: {} frames are the most", kMostFrames);
    }

  private:
    std::size_t frames_ = 0, states_ = 0, valuators_ = 0;
};

} // namespace

struct RecordingWriter::State {
    std::filesystem::path path, temporary;
    std::FILE* file = nullptr;
    std::optional<RecordedFrame> before;
    Seconds flushed{0};

    [[noreturn]] void fail(const std::filesystem::path& where) const {
        throw Error("{}: cannot write: {}", where.string(), system_message());
    }
    void write(const json& value) {
        const std::string line = line_of(value);
        if (std::fwrite(line.data(), 1, line.size(), file) != line.size())
            fail(temporary);
    }
    void flush() {
        if (std::fflush(file) != 0)
            fail(temporary);
    }
    void close() {
        std::FILE* closing = std::exchange(file, nullptr);
        const bool written = std::fflush(closing) == 0 && fsync(fileno(closing)) == 0;
        if (std::fclose(closing) != 0 || !written)
            fail(temporary);
        if (std::rename(temporary.c_str(), path.c_str()) != 0)
            fail(path);
    }
    ~State() {
        if (file)
            std::fclose(file);
    }
};

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header)
    : state_(std::make_unique<State>()) {
    state_->path = path;
    state_->temporary = path.string() + ".part";
    if (std::filesystem::is_directory(path))
        throw Error("{}: cannot write: is a directory", path.string());
    state_->file = std::fopen(state_->temporary.c_str(), "wb");
    if (!state_->file)
        state_->fail(state_->temporary);
    state_->write(to_json(header));
    state_->flush();
}

RecordingWriter::~RecordingWriter() {
    try {
        finish();
    } catch (const Error&) { // what reached the temporary file stays there
    }
}

void RecordingWriter::append(const RecordedFrame& frame) {
    State& s = *state_;
    require_finite(frame);
    if (s.before && frame.input.time < s.before->input.time)
        throw Error("{}: time goes back from {} to {}", s.path.string(),
                    s.before->input.time.count(), frame.input.time.count());
    s.write(to_json(frame, s.before ? &*s.before : nullptr));
    if (!s.before || frame.input.time - s.flushed >= kFlushInterval) {
        s.flush();
        s.flushed = frame.input.time;
    }
    s.before = frame;
}

void RecordingWriter::flush() {
    state_->flush();
}

void RecordingWriter::copy_to(const std::filesystem::path& path) {
    flush();
    const std::filesystem::path part = path.string() + ".part";
    std::error_code error;
    std::filesystem::copy_file(state_->temporary, part, error);
    std::FILE* const copied = error ? nullptr : std::fopen(part.c_str(), "r+b");
    if (copied && (fsync(fileno(copied)) != 0 || std::rename(part.c_str(), path.c_str()) != 0))
        error.assign(errno, std::system_category());
    if (copied && std::fclose(copied) == 0 && !error)
        return;
    if (!error)
        error.assign(errno, std::system_category());
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error("{}: cannot write: {}", path.string(), error.message());
}

void write_recording(const std::filesystem::path& path, const Recording& recording) {
    RecordingWriter writer(path, recording.header);
    for (const RecordedFrame& frame : recording.frames)
        writer.append(frame);
    writer.finish();
}

void RecordingWriter::finish() {
    if (state_->file)
        state_->close();
}

Recording read_recording(std::istream& file, const std::string& name) {
    LineReader reader(file, name);
    if (!reader.next())
        throw Error("{}: not a recording: empty", name);
    Recording recording;
    try {
        recording.header = header_from_json(parse(reader.line()));
    } catch (const Error& error) {
        throw Error(reader.message(error.what()));
    }
    Budget budget;
    while (reader.next()) {
        const RecordedFrame* before = recording.frames.empty() ? nullptr : &recording.frames.back();
        try {
            if (!reader.complete() && !json::accept(reader.line())) {
                recording.note = reader.message("incomplete last line left out");
                break;
            }
            RecordedFrame frame = frame_from_json(parse(reader.line()), before);
            budget.add(frame);
            recording.frames.push_back(std::move(frame));
        } catch (const Error& error) {
            throw Error(reader.message(error.what()));
        }
    }
    if (recording.header.version == 1)
        for (RecordedFrame& frame : recording.frames)
            take_old_bits(frame.input);
    return recording;
}

ReplayInput::ReplayInput(const Recording& recording) : recording_(recording) {}

InputState ReplayInput::poll(Seconds now) {
    const std::vector<RecordedFrame>& frames = recording_.frames;
    if (frames.empty())
        return {now, {}};
    while (next_ < frames.size() && (next_ == 0 || frames[next_].input.time <= now))
        ++next_;
    return frames[next_ - 1].input;
}

std::size_t ReplayInput::frames_played() const {
    return next_;
}

bool ReplayInput::finished() const {
    return next_ == recording_.frames.size();
}

} // namespace isochron::interaction
