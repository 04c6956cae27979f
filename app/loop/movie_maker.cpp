// Movies that a process of their own makes.
#include "app/loop/movie_maker.h"

#include "app/frame/late_latch.h"
#include "app/text.h"
#include "index/system/new_file.h"
#include "interaction/step_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

using interaction::Seconds;

constexpr std::string_view kProgramsName = "isochron: ";

/// `42 %`, as `isochron movie --background` says it.
std::optional<float> progress_in(std::string_view line) {
    int percent = 0;
    const char* const end = line.data() + line.size();
    const auto read = std::from_chars(line.data(), end, percent);
    if (read.ec != std::errc() || std::string_view(read.ptr, end) != " %")
        return std::nullopt;
    return static_cast<float>(percent) / 100.0f;
}

} // namespace

fs::path free_name(const fs::path& folder, std::string_view kind,
                   std::initializer_list<const char*> endings) {
    for (int number = 1;; ++number) {
        fs::path stem = folder / fmt::format("isochron_{}_{:04}", kind, number);
        const auto is_taken = [&](const char* ending) {
            std::error_code ignored;
            return fs::exists(stem.string() + ending, ignored);
        };
        if (std::ranges::none_of(endings, is_taken))
            return stem;
    }
}

fs::path free_recording_name(const fs::path& folder) {
    return free_name(folder, "recording", {".jsonl", ".jsonl.part"}).string() + ".jsonl";
}

MovieMaker::MovieMaker(MovieOrders orders) : orders_(std::move(orders)) {}

MovieMaker::~MovieMaker() {
    finish();
}

void MovieMaker::finish() {
    if (!busy())
        return;
    give_up();
    if (written_.valid())
        written_.wait(); // it writes to a file that has to go
    constexpr int kPauses = 3000;
    constexpr std::chrono::milliseconds kPause{1};
    for (int i = 0; i < kPauses && busy(); ++i) {
        update();
        std::this_thread::sleep_for(kPause);
    }
    if (process_ > 0) {
        kill(process_, SIGKILL);
        int status = 0;
        waitpid(process_, &status, 0);
        end(status);
    }
}

void MovieMaker::make(const Write& write, BackgroundWork& writing, const MovieManner& manner) {
    if (busy())
        return;
    const char* const made = manner.figure ? ".pdf" : ".mp4";
    const char* const source = manner.figure ? ".toml" : ".jsonl";
    const fs::path stem =
        free_name(whole_path(manner.folder.empty() ? orders_.folder : manner.folder),
                  manner.figure ? "figure" : "movie", {made, source});
    manner_ = manner;
    movie_ = stem.string() + made;
    recording_ = stem.string() + source;
    given_up_ = false;
    progress_ = 0;
    const auto written = std::make_shared<std::promise<void>>();
    written_ = written->get_future();
    // A movie that fails is no failure of the recording, which is written there, too.
    writing.post([write, written, path = recording_] {
        try {
            index::make_folder(path.parent_path());
            write(path);
            written->set_value();
        } catch (...) {
            written->set_exception(std::current_exception());
        }
        return std::string();
    });
}

void MovieMaker::give_up() {
    given_up_ = busy();
    if (process_ > 0)
        kill(process_, SIGTERM);
}

std::vector<std::string> MovieMaker::command() const {
    std::vector<std::string> words{orders_.program.string(), manner_.figure ? "figure" : "movie",
                                   recording_.string(), "-o", movie_.string()};
    if (manner_.figure)
        return words;
    words.insert(words.end(), {"--background", "--rate", fmt::format("{}", manner_.rate)});
    if (manner_.titles)
        words.emplace_back("--titles");
    const bool sized = std::ranges::find(orders_.options, "--size") != orders_.options.end();
    if (!sized && manner_.width > 0 && manner_.height > 0)
        words.insert(words.end(),
                     {"--size", std::to_string(manner_.width), std::to_string(manner_.height)});
    words.insert(words.end(), orders_.options.begin(), orders_.options.end());
    for (const std::string& model : manner_.models)
        words.insert(words.end(), {"--model", model});
    return words;
}

void MovieMaker::start() {
    said_.clear();
    last_.clear();
    error_.clear();
    try {
        written_.get();
    } catch (const std::exception& error) {
        last_ = error.what();
        return end(-1);
    }
    if (given_up_)
        return end(-1);
    std::vector<std::string> words = command();
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        last_ = fmt::format("a pipe to the process: {}", std::strerror(errno));
        return end(-1);
    }
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
    pid_t process = -1;
    const int error =
        posix_spawn(&process, orders_.program.c_str(), &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (error != 0) {
        close(ends[0]);
        last_ = fmt::format("{}: {}", orders_.program.string(), std::strerror(error));
        return end(-1);
    }
    process_ = process;
    words_ = ends[0];
    began_ = std::chrono::steady_clock::now();
    fcntl(words_, F_SETFL, O_NONBLOCK);
}

/// What has come of the process's lines.
void MovieMaker::read_words() {
    char bytes[512];
    for (ssize_t count; (count = read(words_, bytes, sizeof bytes)) > 0;)
        said_.append(bytes, static_cast<std::size_t>(count));
    for (std::size_t at; (at = said_.find('\n')) != std::string::npos; said_.erase(0, at + 1)) {
        const std::string line = said_.substr(0, at);
        if (const auto progress = progress_in(line))
            progress_ = *progress;
        else if (!line.empty())
            (line.starts_with(kProgramsName) ? error_ : last_) = line;
    }
}

void MovieMaker::update() {
    constexpr std::chrono::seconds kNoWait{0};
    if (written_.valid() && written_.wait_for(kNoWait) == std::future_status::ready)
        return start();
    if (process_ <= 0)
        return;
    int status = 0;
    const bool ended = waitpid(process_, &status, WNOHANG) == process_;
    read_words();
    if (ended)
        end(status);
}

/// @param status of the process; -1: there was none
void MovieMaker::end(int status) {
    process_ = -1;
    if (words_ >= 0)
        close(std::exchange(words_, -1));
    std::error_code ignored;
    if (status != 0)
        fs::remove(recording_, ignored);
    // Drivers may say something, too, and later.
    if (!error_.empty() && (status != 0 || last_.empty()))
        last_ = error_.substr(kProgramsName.size());
    if (status == 0)
        messages_.push_back(last_);
    else if (given_up_)
        messages_.push_back(fmt::format("canceled: {}", movie_.string()));
    else
        messages_.push_back(
            last_.empty() ? fmt::format("{}: its process ended without a message", movie_.string())
                          : last_);
}

std::optional<float> MovieMaker::progress() const {
    return busy() ? std::optional(progress_) : std::nullopt;
}

std::string MovieMaker::words() const {
    if (process_ <= 0 || progress_ <= 0)
        return process_ > 0 ? last_ : "";
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began_;
    return fmt::format("{}\n{} left", last_,
                       human_time(passed * (1 / static_cast<double>(progress_) - 1)));
}

std::vector<std::string> MovieMaker::messages() {
    return std::exchange(messages_, {});
}

interaction::RecordingHeader sized(interaction::RecordingHeader header,
                                   const interaction::WrittenPictures& pictures) {
    if (pictures.width > 0 && pictures.height > 0)
        header.window = {static_cast<int>(pictures.width), static_cast<int>(pictures.height)};
    return header;
}

interaction::RecordingHeader header_of_view(interaction::RecordingHeader header,
                                            const PictureNote& view) {
    header.data_hash = view.data_hash;
    header.reading = view.reading;
    header.start = view.state;
    header.start.panel = false;
    header.start.room_panel = interaction::RoomPanel{};
    header.start.quality = interaction::QualityMode::quality;
    header.start.leaving = false;
    header.start.story.reset();
    header.start.exporting = interaction::ExportWork{};
    header.start.follow = false;
    header.start.playback = interaction::PlaybackState{};
    return header;
}

interaction::InputState devices_of_view(const PictureNote& view) {
    interaction::InputState input = with_heads(view.input, view.latched);
    std::erase_if(input.devices,
                  [](const interaction::DeviceState& each) { return each.name == "pointer"; });
    for (interaction::DeviceState& device : input.devices) {
        device.buttons = 0;
        device.actions.reset();
        std::ranges::fill(device.valuators, 0.0f);
    }
    return input;
}

/// Frames of a movie of blended steps: more than ten hours of them.
constexpr double kMostMoments = 1 << 20;

interaction::Recording series_seen(interaction::RecordingHeader header, const PictureNote& view,
                                   const interaction::StepTimes& all, double rate) {
    const std::span<const double> times = all.at;
    interaction::Recording recording;
    header = header_of_view(std::move(header), view);
    header.start.instant.emplace();
    const interaction::PlaybackState played =
        view.state.playback.value_or(interaction::PlaybackState{});
    const interaction::InputState seen = devices_of_view(view);
    // A frame's length, and a little, so that no rounding leaves a step out.
    const double least = (1 + 1e-6) / rate;
    const interaction::StepTrack track(
        times, view.state.play_range.value_or(interaction::StepRange{}), played);
    const double per_second = interaction::track_rate(played, times);
    double start = 0;
    const double seconds = track.start(track.last()) / per_second;
    // Its frames are instants, unless there are fewer frames than steps.
    const bool blends = view.state.between == interaction::BetweenSteps::blend &&
                        played.every == 1 && std::isfinite(seconds) && per_second > 0 &&
                        seconds * rate >= track.last();
    if (blends) {
        const auto count = static_cast<std::uint64_t>(std::min(seconds * rate, kMostMoments));
        for (std::uint64_t i = 0; i <= count; ++i) {
            start = static_cast<double>(i) / rate;
            const double at = played.reverse ? seconds - start : start;
            interaction::RecordedFrame frame{.input = seen, .commands = {}, .from_panel = {}};
            frame.input.time = Seconds(start);
            frame.commands.instant = track.instant_at(at * per_second, all.gaps);
            recording.frames.push_back(std::move(frame));
        }
        start += least;
    }
    for (std::uint32_t i = 0; !blends && i < track.places(); ++i) {
        interaction::RecordedFrame frame{.input = seen, .commands = {}, .from_panel = {}};
        const std::uint32_t place = played.reverse ? track.last() - i : i;
        frame.input.time = Seconds(start);
        frame.commands.instant.emplace(track.step(place));
        const double lasts = (track.start(place + 1) - track.start(place)) / per_second;
        start += std::isfinite(lasts) ? std::max(least, lasts) : least;
        recording.frames.push_back(std::move(frame));
    }
    if (!recording.frames.empty()) { // the last one lasts, too
        interaction::RecordedFrame last = recording.frames.back();
        last.input.time = std::max(last.input.time, Seconds(start - least));
        last.commands = {};
        recording.frames.push_back(std::move(last));
    }
    recording.header = std::move(header);
    return recording;
}

} // namespace isochron::app
