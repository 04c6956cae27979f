// `isochron movie`: a recording, or all steps of an index, become a movie.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/explore/replay_source.h"
#include "app/explore/series_movie.h"
#include "app/kept/recording_file.h"
#include "app/output/guarded_outputs.h"
#include "app/output/movie_file.h"
#include "app/output/picture_parts.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/file/sections/file_layout.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "render/gl/driver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>

#include <sys/prctl.h>
#include <sys/resource.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct MovieOptions : ReplaySource {
    SeriesMovie series;
    std::string out, eyes = "window";
    double rate = 30;
    bool force = false, background = false;
};

/// One movie for the window, or one for each eye and viewport; written in the background.
class Movies {
  public:
    Movies(const MovieOptions& options, const PictureNames& names, MovieNote about,
           const Reads& reads, BackgroundWork& writing)
        : options_(options), names_(names), about_(std::move(about)), reads_(reads),
          writing_(writing) {}

    /// Adds the pictures of the frame drawn last. @param times how many movie frames show them
    void add(Outputs& outputs, const PictureNote& frame, std::size_t times) {
        hurried_ = render::draws_in_software(outputs.gl());
        each_part(outputs, options_.eyes == "each", names_, frame,
                  [&](const PictureNote& note, const std::string& suffix, render::Image image) {
                      add(note, suffix, std::move(image), times);
                  });
    }

    /// Completes the movies, and reports each.
    void finish() {
        writing_.finish();
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (auto& [path, movie] : movies_) {
            movie->finish();
            print_report("wrote {}: {} frames at {:g} per second\n", path.string(), movie->frames(),
                         options_.rate);
            all.push_back({{"file", path.string()}, {"frames", movie->frames()}});
        }
        tell_result({{"source", options_.recording}, {"rate", options_.rate}, {"movies", all}});
    }

  private:
    fs::path path_with(const std::string& suffix) const {
        const fs::path out(options_.out);
        if (!out.has_filename()) // a folder, also one with a dot in its name
            return fs::path(out.parent_path().string() + suffix) / "";
        return out.parent_path() / (out.stem().string() + suffix + out.extension().string());
    }

    std::shared_ptr<Movie> open(const fs::path& path, PictureNote note, glm::ivec2 size) const {
        if (is_movie_folder(path))
            return std::make_shared<MovieFolder>(path);
        note.movie = about_;
        return std::make_shared<MovieFile>(path, size, options_.rate, text_of(note), hurried_);
    }

    void add(const PictureNote& note, const std::string& suffix, render::Image image,
             std::size_t times) {
        const fs::path path = path_with(suffix);
        auto& movie = movies_[path];
        if (!movie) {
            guard_outputs({{path, OutputKind::movie}}, reads_, options_.force);
            movie = open(path, note, glm::ivec2(image.width, image.height));
        }
        writing_.wait_for_room();
        // A message there means that the movie cannot be written: the other frames are not drawn.
        if (const auto said = writing_.messages(); !said.empty())
            throw index::Error(said.front());
        writing_.post([movie = movie, image = std::move(image), times, text = text_of(note)] {
            for (std::size_t i = 0; i < times; ++i)
                movie->add(image, text);
            return std::string();
        });
    }

    const MovieOptions& options_;
    const PictureNames& names_;
    const MovieNote about_;
    const Reads& reads_;
    BackgroundWork& writing_;
    bool hurried_ = false; ///< drawing and encoding use the same processors
    std::map<fs::path, std::shared_ptr<Movie>> movies_;
};

/// Counts the movie frames that show a recorded frame: those before the next recorded frame's time.
class Clock {
  public:
    Clock(const interaction::Recording& recording, double rate)
        : recording_(recording), rate_(rate) {}
    std::size_t frames_of(std::size_t number) {
        const auto& frames = recording_.frames;
        const double start = frames.front().input.time.count();
        // The last one is shown for one frame.
        const double end = number + 1 < frames.size()
                               ? frames[number + 1].input.time.count() - start
                               : (static_cast<double>(next_) + 0.5) / rate_;
        std::size_t count = 0;
        for (; static_cast<double>(next_) / rate_ < end; ++next_)
            ++count;
        return count;
    }

  private:
    const interaction::Recording& recording_;
    double rate_;
    std::uint64_t next_ = 0; ///< next frame of the movie
};

/// Hash of the recording's content.
std::string hash_of(const fs::path& recording) {
    constexpr std::uint64_t kLargest = std::uint64_t{1} << 34;
    const std::string text = index::read_text(recording, kLargest);
    return fmt::format("{:016x}", index::checksum_of(std::as_bytes(std::span(text))));
}

/// Whether the film is kept as a recording, which `replay` plays, and not drawn.
bool writes_recording(const MovieOptions& options) {
    return fs::path(options.out).extension() == ".jsonl";
}

/// What cannot be written is told before anything is drawn.
void check_output(const MovieOptions& options) {
    const fs::path out(options.out);
    constexpr std::array kSuffixes{".mp4", ".mkv", ".mov", ".gif", ".jsonl"};
    if (is_movie_folder(out))
        return;
    if (std::ranges::find(kSuffixes, out.extension().string()) == kSuffixes.end())
        throw UsageError(
            fmt::format("--output: expected a name that ends in {}, or a folder, got {}",
                        fmt::join(kSuffixes, ", "), options.out));
    index::NewFile{out};
}

/// Options that only one kind of source has. @throws UsageError
void check_source(const MovieOptions& options, bool of_index) {
    const SeriesMovie& series = options.series;
    if (!of_index && (series.isovalue || !series.steps.empty() || series.between || series.turn ||
                      !series.keys.empty()))
        throw UsageError(fmt::format(
            "{}: a recording has its own view, isovalues, steps and moments between them; "
            "--isovalue, --steps, --between, --keys and --turn go with an index",
            options.recording));
    if (!series.keys.empty() && (series.turn || !series.steps.empty()))
        throw UsageError("--keys: the keys say where to look and which steps pass; --turn and "
                         "--steps go without them");
    if (!of_index && writes_recording(options))
        throw UsageError(fmt::format("{}: it is a recording already; a recording is made of an "
                                     "index: isochron movie INDEX --turn -o film.jsonl",
                                     options.recording));
    if (of_index && options.data)
        throw UsageError("--data goes with a recording; an index is the data itself");
}

/// `film.mp4: 12 s, 361 frames at 30 per second, 1280 x 720`.
std::string words_of_film(const MovieOptions& options, const interaction::Recording& recording,
                          const glm::ivec2& size) {
    const double seconds =
        recording.frames.back().input.time.count() - recording.frames.front().input.time.count();
    Clock clock(recording, options.rate);
    std::size_t frames = 0;
    for (std::size_t i = 0; i < recording.frames.size(); ++i)
        frames += clock.frames_of(i);
    return fmt::format("{}: {:.4g} s, {} frames at {:g} per second, {} x {} pixels",
                       whole_path(options.out), seconds, frames, options.rate, size.x, size.y);
}

void keep_recording(const MovieOptions& options, const interaction::Recording& recording,
                    const Reads& reads) {
    guard_outputs({{options.out, OutputKind::recording}}, reads, options.force);
    write_recording(options.out, recording);
    print_report("wrote {}: {} frames at {:g} per second; `isochron replay` plays them\n",
                 options.out, recording.frames.size(), options.rate);
    tell_result({{"source", options.recording},
                 {"rate", options.rate},
                 {"movies", {{{"file", options.out}, {"frames", recording.frames.size()}}}}});
}

/// For the program that started this one: `42 %`.
void tell(double done) {
    print_answer("{} %\n", static_cast<int>(100 * done));
    std::fflush(stdout);
}

/// Whatever needs a processor goes first; nobody waits for the movie of a program that is gone.
void go_to_background() {
    constexpr int kPolite = 10;
    setpriority(PRIO_PROCESS, 0, kPolite);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
}

void make_movie(const MovieOptions& options, ClusterJob& job) {
    if (job.size() > 1)
        throw UsageError("a movie is made by one process, without mpirun");
    if (options.background)
        go_to_background();
    check_output(options);
    const bool of_index = index::is_index(options.recording);
    check_source(options, of_index);
    interaction::Recording recording;
    if (of_index)
        recording.header = header_of_series(options);
    else
        recording = read_recording(options.recording);
    if (recording.frames.empty() && !of_index)
        throw interaction::Error(options.recording + ": it has no frames");
    Config config = config_of(options, recording.header);
    config.pictures.only_kept = true;
    const auto file = data_of(options, recording.header, config);
    Session session(config, file, windows_of(options, config, recording.header, job));
    const ReplayOptions replay = replay_options(options);
    session.set_data_name(data_name(options, recording.header),
                          other_data(recording.header, *file));
    session.set_state(start_of(recording.header, session.state(), file->info().steps(), replay));
    if (of_index)
        recording =
            steps_seen(session, config, *file, recording.header, options.series, options.rate);
    Reads reads = reads_of(options, file.get());
    if (!options.series.keys.empty())
        reads.files.emplace_back(options.series.keys);
    if (writes_recording(options))
        return keep_recording(options, recording, reads);
    print_report("{}\n",
                 words_of_film(options, recording, config.installation.windows.front().size));
    const PictureNames names = picture_names(config.installation);
    BackgroundWork writing;
    Movies movies(options, names, {options.rate, of_index ? "" : hash_of(options.recording)}, reads,
                  writing);
    Clock clock(recording, options.rate);
    {
        const CancelOnSignal signals;
        ProgressBar bar;
        try {
            replay_fixed_step(session, recording, replay,
                              [&](std::size_t number, const interaction::RecordedFrame&) {
                                  signals.check();
                                  if (const std::size_t times = clock.frames_of(number))
                                      movies.add(session.outputs(), session.note(), times);
                                  const double done = static_cast<double>(number + 1) /
                                                      static_cast<double>(recording.frames.size());
                                  if (options.background)
                                      tell(done);
                                  else
                                      bar.show("making the movie", done);
                              });
        } catch (const index::Error&) { // Ctrl-C ends a wait for cells, too
            signals.check();
            throw;
        }
    }
    movies.finish();
}

} // namespace

void add_movie(Command& program) {
    auto options = std::make_shared<MovieOptions>();
    Command command = program.subcommand(
        "movie", "Make a movie of a recording, or of all steps of an index: a file that ffmpeg "
                 "encodes, or a folder of its frames.");
    command.examples({"isochron movie walk.jsonl -o walk.mp4",
                      "isochron movie run42.isochron --turn -o turn.mp4"});
    add_replay_source(command, *options,
                      "Recording made by `explore --record`. Or an index: the movie then shows all "
                      "its steps from where `explore` looks first, in 10 s, or in more where each "
                      "step needs a frame");
    command
        .option("-o,--output,--out", options->out,
                "Movie to write: .mp4, .mkv or .mov (H.264), or .gif; or a folder for its frames "
                "(.png); or .jsonl, the film of an index as a recording, which `replay` plays")
        .required()
        .type_name("FILE");
    command
        .option(
            "--isovalue", options->series.isovalue,
            "With an index: isovalue of the surface (default: the one that `explore` shows first)")
        .type_name("VALUE");
    command
        .option("--steps,--step", options->series.steps,
                "With an index: steps to show, numbered from 0: `0:63` for 0 to 63, or `0:63:4` "
                "for every fourth of them (default: all)")
        .type_name("FIRST:LAST[:STRIDE]");
    command
        .option(
            "--between", options->series.between,
            "With an index: what to show between two steps: `hold` shows the step before, `blend` "
            "a blend of both (default: what `isochron info` advises)")
        .one_of(interaction::all_names<interaction::BetweenSteps>())
        .type_name("MODE");
    command
        .option("--keys", options->series.keys,
                "With an index: file of the key frames that the film goes through "
                "(docs/FORMATS.md), or a session that has "
                "keys (Ctrl + M in `explore`)")
        .type_name("FILE");
    const Option turn =
        command.flag("--turn", options->series.turn,
                     "With an index: one turn about the data's up axis while the steps pass; with "
                     "`--steps 5`, while step 5 stands");
    command.option("--length", options->series.seconds, "Length of the turn")
        .between(0.1, interaction::kLongestFilm)
        .needs(turn)
        .shows_default()
        .type_name("SECONDS");
    command.option("--rate", options->rate, "Frames per second")
        .positive()
        .shows_default()
        .type_name("RATE");
    command
        .option("--eyes", options->eyes,
                "`window` makes one movie of what the window shows; `each` makes a movie for each "
                "eye of each viewport and adds their names to the name of --output")
        .one_of({"window", "each"})
        .shows_default()
        .type_name("EYES");
    command.flag("--force", options->force, "Replace a movie that exists");
    command.flag(
        "--background", options->background,
        "Work as the panel's movies do: at low priority, with progress in lines on stdout, "
        "and only as long as the program that started this one runs");
    command.footer("Each frame is drawn for its time in the movie. `replay --every` writes single "
                   "pictures.");
    command.on_run(
        [options] { run_in_cluster([&](ClusterJob& job) { make_movie(*options, job); }); });
}

} // namespace isochron::app
