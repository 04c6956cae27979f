// Sends pictures through a pipe to ffmpeg.
#include "app/output/movie_file.h"

#include "app/output/picture_note.h"
#include "index/error.h"
#include "index/system/new_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

/// A name that ffmpeg takes for nothing but a file: `10:30.mp4` would be a protocol, and what begins
/// with a slash is none.
std::string for_ffmpeg(const fs::path& file) {
    return fs::absolute(file).string();
}

/// Writes the note as ffmpeg's file of metadata: an argument may have 128 KiB only.
void write_metadata(const fs::path& path, const std::string& note) {
    std::string text = ";FFMETADATA1\ncomment=";
    for (const char c : note) {
        if (std::string_view("=;#\\\n").find(c) != std::string_view::npos)
            text += '\\';
        text += c;
    }
    text += '\n';
    index::write_file(path, text);
}

/// @param metadata file with the note; empty: none
std::vector<std::string> arguments_for(const fs::path& out, glm::ivec2 size, double rate,
                                       const fs::path& metadata, bool hurried) {
    std::vector<std::string> all{"ffmpeg",    "-hide_banner",
                                 "-nostdin",  "-y",
                                 "-loglevel", "error",
                                 "-f",        "rawvideo",
                                 "-pix_fmt",  "rgba",
                                 "-s",        fmt::format("{}x{}", size.x, size.y),
                                 "-r",        fmt::format("{}", rate),
                                 "-i",        "pipe:0"};
    if (!metadata.empty())
        all.insert(all.end(),
                   {"-f", "ffmetadata", "-i", for_ffmpeg(metadata), "-map_metadata", "1"});
    const auto add = [&](std::initializer_list<const char*> more) {
        all.insert(all.end(), more.begin(), more.end());
    };
    if (out.extension() == ".gif")
        add({"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"});
    else if (out.extension() == ".webm") // realtime: as fast as H.264 is
        add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libvpx-vp9", "-crf", "24", "-b:v",
             "0", "-deadline", hurried ? "realtime" : "good", "-cpu-used", hurried ? "7" : "4",
             "-row-mt", "1", "-pix_fmt", "yuv420p"});
    else // players want even sides and color at half resolution
        add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-preset",
             hurried ? "ultrafast" : "veryfast", "-crf", "16", "-pix_fmt", "yuv420p", "-movflags",
             "+faststart"});
    all.push_back(for_ffmpeg(out));
    return all;
}

} // namespace

/// Both ends of a pipe; the destructor closes those that are still open.
struct FfmpegPipe {
    int ends[2]{-1, -1};
    FfmpegPipe() {
        if (pipe2(ends, O_CLOEXEC) != 0)
            throw index::Error("a pipe to ffmpeg: {}", std::strerror(errno));
    }
    ~FfmpegPipe() {
        close_end(0);
        close_end(1);
    }
    FfmpegPipe(const FfmpegPipe&) = delete;
    FfmpegPipe& operator=(const FfmpegPipe&) = delete;
    void close_end(int end) {
        if (const int open = std::exchange(ends[end], -1); open >= 0)
            close(open);
    }
};

struct MovieFile::State {
    fs::path path;
    index::TemporaryFolder folder;
    fs::path temporary; ///< in it, with the suffix by which ffmpeg knows the format
    glm::ivec2 size;
    std::string note;
    FfmpegPipe pictures, complaints;
    pid_t ffmpeg = -1;
    std::size_t frames = 0;

    State(fs::path target, glm::ivec2 pixels, double rate, std::string text, bool hurried)
        : path(std::move(target)), folder(index::end_of_links(path), "movie"),
          temporary(folder.path() / ("movie" + path.extension().string())), size(pixels),
          note(std::move(text)) {
        std::signal(SIGPIPE, SIG_IGN); // so that writing reports an error when ffmpeg has ended
        fs::path metadata;
        if (!note.empty() && path.extension() != ".gif") {
            metadata = folder.path() / "movie.note";
            write_metadata(metadata, note);
        }
        std::vector<std::string> words = arguments_for(temporary, size, rate, metadata, hurried);
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_adddup2(&files, pictures.ends[0], STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&files, complaints.ends[1], STDERR_FILENO);
        const int error =
            posix_spawnp(&ffmpeg, "ffmpeg", &files, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&files);
        if (error != 0)
            throw index::Error("{}: movies are written by ffmpeg, which cannot be started: {} "
                               "(Debian: apt install ffmpeg)",
                               path.string(), std::strerror(error));
        pictures.close_end(0);
        complaints.close_end(1);
    }
    ~State() {
        if (ffmpeg > 0) {
            kill(ffmpeg, SIGKILL);
            waitpid(ffmpeg, nullptr, 0);
        }
    }

    /// Waits until ffmpeg ends. @return its error message, one line; empty: all is well
    std::string wait() {
        pictures.close_end(1);
        std::string said;
        char bytes[512];
        for (ssize_t count; (count = read(complaints.ends[0], bytes, sizeof bytes)) > 0;)
            said.append(bytes, static_cast<std::size_t>(count));
        int status = 0;
        waitpid(std::exchange(ffmpeg, -1), &status, 0);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
            return {};
        return said.empty() ? "it ended without a word" : said.substr(0, said.find('\n'));
    }
    [[noreturn]] void fail() {
        const std::string said = ffmpeg > 0 ? wait() : std::string();
        throw index::Error("{}: ffmpeg: {}", path.string(),
                           said.empty() ? "it took no more pictures" : said);
    }
};

MovieFile::MovieFile(fs::path path, glm::ivec2 size, double rate, std::string note, bool hurried)
    : state_(std::make_unique<State>(std::move(path), size, rate, std::move(note), hurried)) {}
MovieFile::~MovieFile() = default;

void MovieFile::add(const render::Image& image, const std::string&) {
    State& s = *state_;
    if (image.width != s.size.x || image.height != s.size.y)
        throw index::Error("{}: a picture of {} x {}, the movie has {} x {}", s.path.string(),
                           image.width, image.height, s.size.x, s.size.y);
    for (std::size_t done = 0; done < image.rgba.size();) {
        const ssize_t count =
            write(s.pictures.ends[1], image.rgba.data() + done, image.rgba.size() - done);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            s.fail();
        done += static_cast<std::size_t>(count);
    }
    ++s.frames;
}

std::size_t MovieFile::frames() const {
    return state_->frames;
}

void MovieFile::finish() {
    State& s = *state_;
    const std::string said = s.wait();
    if (!said.empty())
        throw index::Error("{}: ffmpeg: {}", s.path.string(), said);
    if (s.path.extension() == ".gif" && !s.note.empty())
        add_note_to_gif(s.temporary, s.note);
    index::name_whole_file(s.temporary, s.path);
}

} // namespace isochron::app
