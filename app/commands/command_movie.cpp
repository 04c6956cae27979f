// `isochron movie`: a recording, or all steps of an index, become a movie.
#include "app/command_line/cancel.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/subcommands.h"
#include "app/explore/replay_source.h"
#include "app/explore/series_movie.h"
#include "app/frame/late_latch.h"
#include "app/kept/recording_file.h"
#include "app/loop/film_titles.h"
#include "app/output/guarded_outputs.h"
#include "app/output/kept_frames.h"
#include "app/output/movie_file.h"
#include "app/output/panorama.h"
#include "app/output/picture_parts.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/error.h"
#include "index/file/index_series.h"
#include "index/file/sections/file_layout.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "interaction/recording/recording_json.h"
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
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <sys/prctl.h>
#include <sys/resource.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

constexpr int kPanoramaSize = 4096; ///< [pixel] of both eyes' pictures, if nobody says

struct MovieOptions : ReplaySource {
    SeriesMovie series;
    std::string out, eyes = "window";
    double rate = 30;
    bool force = false, background = false, panorama = false;
};

/// One movie for the window, or one for each eye and viewport; written in the background.
class Movies {
  public:
    /// @param hurried drawing and encoding use the same processors
    Movies(const MovieOptions& options, MovieNote about, const Reads& reads,
           BackgroundWork& writing, bool hurried)
        : options_(options), about_(std::move(about)), reads_(reads), writing_(writing),
          hurried_(hurried) {}

    /// Adds the pictures of a frame. @param times how many movie frames show them
    void add(std::vector<FramePart> parts, std::size_t times) {
        for (FramePart& part : parts)
            add(std::move(part), times);
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

    std::shared_ptr<Movie> open(const fs::path& path, const FramePart& first) const {
        if (is_movie_folder(path))
            return std::make_shared<MovieFolder>(path);
        PictureNote note = note_from(first.note);
        note.movie = about_;
        return std::make_shared<MovieFile>(path, glm::ivec2(first.image.width, first.image.height),
                                           options_.rate, text_of(note), hurried_);
    }

    void add(FramePart part, std::size_t times) {
        const fs::path path = path_with(part.suffix);
        auto& movie = movies_[path];
        if (!movie) {
            guard_outputs({{path, OutputKind::movie}}, reads_, options_.force);
            movie = open(path, part);
        }
        writing_.wait_for_room();
        // A message there means that the movie cannot be written: the other frames are not drawn.
        if (const auto said = writing_.messages(); !said.empty())
            throw index::Error(said.front());
        writing_.post([movie = movie, part = std::move(part), times] {
            for (std::size_t i = 0; i < times; ++i)
                movie->add(part.image, part.note);
            return std::string();
        });
    }

    const MovieOptions& options_;
    const MovieNote about_;
    const Reads& reads_;
    BackgroundWork& writing_;
    const bool hurried_;
    std::map<fs::path, std::shared_ptr<Movie>> movies_;
};

/// How many movie frames show each recorded frame: those before the next recorded frame's time.
std::vector<std::size_t> shown_frames(const interaction::Recording& recording, double rate) {
    const auto& frames = recording.frames;
    const double start = frames.front().input.time.count();
    std::vector<std::size_t> counts(frames.size());
    std::uint64_t next = 0; // frame of the movie
    for (std::size_t i = 0; i < frames.size(); ++i) {
        // The last one is shown for one frame.
        const double end = i + 1 < frames.size() ? frames[i + 1].input.time.count() - start
                                                 : (static_cast<double>(next) + 0.5) / rate;
        for (; static_cast<double>(next) / rate < end; ++next)
            ++counts[i];
    }
    return counts;
}

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
    constexpr std::array kSuffixes{".mp4", ".mkv", ".mov", ".webm", ".gif", ".jsonl"};
    if (is_movie_folder(out))
        return;
    if (std::ranges::find(kSuffixes, out.extension().string()) == kSuffixes.end())
        throw UsageError("--output: expected a name that ends in {}, or a folder, got {}",
                         fmt::join(kSuffixes, ", "), options.out);
    index::NewFile{out};
}

/// Options that only one kind of source has. @throws UsageError
void check_source(const MovieOptions& options, bool of_index) {
    const SeriesMovie& series = options.series;
    if (!of_index && (series.isovalue || series.steps || series.between || series.turn ||
                      !series.film.empty() || !series.keys.empty()))
        throw UsageError(
            "{}: a recording has its own view, isovalues, steps and moments between them; "
            "--isovalue, --steps, --between, --keys, --film and --turn go with an index",
            options.recording);
    if (!series.keys.empty() && (series.turns() || !series.film.empty() || series.steps))
        throw UsageError("--keys: the keys say where to look and which steps pass; --film, --turn "
                         "and --steps go without them");
    if (series.length && !series.turns())
        throw UsageError("--length: it is the length of a turn; expected it with --turn or --film");
    if (series.turn && series.film == "time")
        throw UsageError("--turn: `--film time` has no turn; expected one of the two");
    if (series.titles && of_index && series.keys.empty())
        throw UsageError("--titles: they are the names and texts of keys; expected --keys FILE, or "
                         "the recording of a film or story that has them");
    if (series.titles && options.panorama)
        throw UsageError("--titles: a panorama has no words; expected one of the two");
    if (options.panorama && (options.emulate || options.stereo || options.eyes == "each"))
        throw UsageError("--panorama: it has both eyes, the left one's picture above the right "
                         "one's; --emulate, --stereo and --eyes go without it");
    if (options.panorama && options.size.size() == 2 &&
        (options.size[0] != options.size[1] || options.size[0] % 2 != 0 ||
         options.size[0] < PanoramaPlan::kNarrowest))
        throw UsageError("--size: a panorama of both eyes is a square; expected the same even "
                         "number twice, from {} on, got {} {}",
                         PanoramaPlan::kNarrowest, options.size[0], options.size[1]);
    if (options.panorama && writes_recording(options))
        throw UsageError("--panorama: a recording has no pictures; give the option to the movie "
                         "that is made of it");
    if (!of_index && writes_recording(options))
        throw UsageError("{}: it is a recording already; a recording is made of an index: isochron "
                         "movie INDEX --turn -o film.jsonl",
                         options.recording);
    if (of_index && options.data)
        throw UsageError("--data goes with a recording; an index is the data itself");
}

/// `film.mp4: 12 s, 361 frames at 30 per second, 1280 x 720`.
std::string words_of_film(const MovieOptions& options, const interaction::Recording& recording,
                          const glm::ivec2& size) {
    const double seconds =
        recording.frames.back().input.time.count() - recording.frames.front().input.time.count();
    const auto counts = shown_frames(recording, options.rate);
    const std::size_t frames = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    return fmt::format("{}: {:.4g} s, {} frames at {:g} per second, {} x {} pixels",
                       whole_path(options.out), seconds, frames, options.rate, size.x, size.y);
}

/// Words in corners would stand in every view that a panorama is put together from, and the box's
/// numbers would be cut where two views meet.
void without_words(Session& session, interaction::Recording& recording) {
    ExplorerState state = session.state();
    state.pictures.legend = state.pictures.scale_bar = state.pictures.box = state.pictures.caption =
        false;
    state.orthographic = false;
    session.set_state(state);
    recording.header.start.pictures = state.pictures;
    for (interaction::RecordedFrame& frame : recording.frames) {
        frame.commands.pictures.reset();
        frame.commands.orthographic.reset();
    }
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

bool has_words(const std::vector<Title>& titles) {
    return std::ranges::any_of(titles, [](const Title& title) { return !title.words.empty(); });
}

/// Whether each picture shows what its own frame says, whatever was drawn before: frames may be left
/// out then.
bool stands_alone(const Config& config, const interaction::Recording& recording,
                  const ReplayOptions& replay) {
    using interaction::QualityMode;
    const auto steered = [&](const interaction::RecordedFrame& frame) {
        return (frame.commands.quality && !replay.quality) || !frame.from_panel.empty() ||
               std::ranges::any_of(frame.input.devices, [](const interaction::DeviceState& device) {
                   return device.pose_lost || !device.pose_valid;
               });
    };
    const auto quality = replay.quality ? replay.quality : recording.header.start.quality;
    return quality == QualityMode::quality && !config.comfort.vignette &&
           recording.header.start.room_panel.value_or(interaction::RoomPanel{}) ==
               interaction::RoomPanel{} &&
           std::ranges::none_of(recording.frames, steered);
}

/// All that decides what the frames of a movie show.
std::string question_of(const MovieOptions& options, const interaction::Recording& recording,
                        const PictureNote& start) {
    std::string question = fmt::format("{}\n{} {} {}\n", text_of(start), options.eyes,
                                       options.emulate, options.panorama);
    for (const auto& option : {options.stereo, options.quality, options.footprint})
        question += option.value_or("") + '\n';
    question += options.series.titles ? "titles\n" : "";
    question += interaction::to_json(recording.header).dump() + '\n';
    const interaction::RecordedFrame* before = nullptr;
    for (const interaction::RecordedFrame& frame : recording.frames) {
        question += interaction::to_json(frame, before).dump() + '\n';
        before = &frame;
    }
    return question;
}

/// Draws the frames of a recording, or takes those that an earlier process has drawn.
class FrameDrawing {
  public:
    FrameDrawing(const MovieOptions& options, Session& session, PictureNames names,
                 std::optional<PanoramaPlan> panorama, const stereo::Viewer& viewer)
        : options_(options), session_(session), names_(std::move(names)),
          panorama_(std::move(panorama)), viewer_(viewer) {}

    /// The frames to draw for one frame of the recording: those of all sectors.
    std::size_t views() const { return panorama_ ? panorama_->sectors() : 1; }
    /// The recording with these frames.
    interaction::Recording drawn(const interaction::Recording& recording) const {
        if (!panorama_)
            return recording;
        interaction::Recording drawn{recording.header, {}, {}};
        for (const interaction::RecordedFrame& frame : recording.frames)
            for (std::size_t i = 0; i < views(); ++i) {
                interaction::RecordedFrame& one = drawn.frames.emplace_back(
                    i == 0 ? frame : interaction::RecordedFrame{frame.input, {}, {}});
                one.input = panorama_->turned(with_heads(frame.input, frame.latched), viewer_, i);
                one.latched = {};
            }
        return drawn;
    }
    /// Takes the picture of the frame drawn last. @param view from 0 to `views`
    /// @return the pictures of the recorded frame; empty: not all of its views are drawn
    std::vector<FramePart> take(std::size_t view) {
        std::vector<FramePart> parts;
        if (panorama_ && view == 0)
            sheet_.emplace(*panorama_);
        const PictureNote frame = session_.note();
        each_part(session_.outputs(), panorama_ || options_.eyes == "each", names_, frame,
                  [&](const PictureNote& note, const std::string& suffix, render::Image image) {
                      if (panorama_)
                          sheet_->add(view, note.part, image);
                      else
                          parts.push_back({suffix, text_of(note), std::move(image)});
                  });
        if (panorama_ && view + 1 == views())
            parts.push_back({"", text_of(session_.outputs().noted(frame, {.shows = "panorama"})),
                             sheet_->take()});
        return parts;
    }

  private:
    const MovieOptions& options_;
    Session& session_;
    const PictureNames names_;
    const std::optional<PanoramaPlan> panorama_;
    const stereo::Viewer viewer_;
    std::optional<PanoramaSheet> sheet_;
};

/// Draws what is not kept, and adds all frames to the movies, in their order.
void draw_frames(const MovieOptions& options, Session& session,
                 const interaction::Recording& recording, const ReplayOptions& replay,
                 FrameDrawing& drawing, KeptFrames& kept, bool alone, Movies& movies,
                 BackgroundWork& writing) {
    const auto counts = shown_frames(recording, options.rate);
    const std::size_t views = drawing.views();
    std::size_t to_draw = 0, drawn = 0;
    for (std::size_t i = 0; i < counts.size(); ++i)
        to_draw += counts[i] > 0 && !kept.holds(i);
    if (const std::size_t there =
            std::ranges::count_if(counts, [](auto n) { return n > 0; }) - to_draw;
        there > 0)
        print_report("going on: {} of its pictures are there, in {}\n", there,
                     whole_path(kept.folder().string()));
    std::optional<std::vector<FramePart>> read; ///< parts of the frame that comes next
    const CancelOnSignal signals;
    ProgressBar bar;
    std::vector<Title> titles;
    if (options.series.titles)
        titles = titles_of(recording);
    const Skips skips = [&](std::size_t number) {
        const std::size_t frame = number / views;
        if (!titles.empty())
            session.set_title(titles[frame]);
        if (number % views == 0 && counts[frame] > 0)
            read = kept.read(frame);
        return read ? alone : alone && counts[frame] == 0;
    };
    const auto done = [&](std::size_t number, const interaction::RecordedFrame&) {
        signals.check();
        const std::size_t frame = number / views, view = number % views;
        if (counts[frame] == 0)
            return;
        std::vector<FramePart> parts;
        if (!read)
            parts = drawing.take(view);
        else if (view + 1 == views)
            parts = std::move(*read);
        if (parts.empty())
            return;
        if (!read) {
            ++drawn;
            writing.wait_for_room();
            writing.post([&kept, frame, parts] {
                kept.keep(frame, parts);
                return std::string();
            });
        }
        read.reset();
        movies.add(std::move(parts), counts[frame]);
        const double share =
            to_draw == 0 ? 1.0
                         : std::min(1.0, static_cast<double>(drawn) / static_cast<double>(to_draw));
        if (options.background)
            tell(share);
        else
            bar.show("making the movie", share);
    };
    try {
        replay_fixed_step(session, drawing.drawn(recording), replay, done, skips);
    } catch (const index::Error&) { // Ctrl-C ends a wait for cells, too
        signals.check();
        throw;
    }
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
    ReplayOptions replay = replay_options(options);
    std::optional<PanoramaPlan> panorama;
    if (options.panorama) {
        const int width = options.size.empty() ? kPanoramaSize : options.size[0];
        panorama.emplace(glm::ivec2(width));
        panorama->prepare(config.installation);
        config.pictures.caption = false;
        replay.stereo = stereo::StereoMode::top_bottom;
        replay.quality =
            interaction::QualityMode::quality; // the head that turns is nobody's motion
        recording.header.start.stereo = name_of(*replay.stereo);
    }
    const auto file = data_of(options, recording.header, config);
    Session session(config, file, windows_of(options, config, recording.header, job));
    session.set_data_name(data_name(options, recording.header),
                          other_data(recording.header, *file));
    let_show_models(options, session);
    session.set_state(start_of(recording.header, session.state(), file->info().steps(), replay));
    if (of_index)
        recording =
            steps_seen(session, config, *file, recording.header, options.series, options.rate);
    if (options.series.titles && !of_index && !has_words(titles_of(recording)))
        throw interaction::Error(
            options.recording + ": --titles: expected the recording of a film with titles, or of a "
                                "story that is told");
    if (panorama)
        without_words(session, recording);
    Reads reads = reads_of(options, file.get());
    if (!options.series.keys.empty())
        reads.files.emplace_back(options.series.keys);
    if (writes_recording(options))
        return keep_recording(options, recording, reads);
    print_report("{}\n", words_of_film(options, recording,
                                       panorama ? panorama->size()
                                                : config.installation.windows.front().size));
    if (options.eyes == "window" && config.installation.windows.size() == 1)
        guard_outputs({{options.out, OutputKind::movie}}, reads, options.force);
    KeptFrames kept(options.out,
                    question_of(options, recording, session.outputs().noted(session.note(), {})));
    for (const fs::path& other : kept.others())
        print_note("{}: pictures of a movie of this name that was not finished; remove the folder "
                   "unless you make that movie",
                   whole_path(other.string()));
    FrameDrawing drawing(options, session, picture_names(config.installation), panorama,
                         config.installation.viewers.front());
    try {
        BackgroundWork writing;
        Movies movies(options, {options.rate, of_index ? "" : hash_of(options.recording)}, reads,
                      writing, render::draws_in_software(session.outputs().gl()));
        draw_frames(options, session, recording, replay, drawing, kept,
                    stands_alone(config, recording, replay), movies, writing);
        movies.finish();
        say_faults(session.models());
    } catch (const Canceled&) {
        if (options.background) // the panel's button deletes
            kept.remove();
        else
            print_note("the pictures so far are kept in {}; the same command goes on",
                       whole_path(kept.folder().string()));
        throw;
    } catch (...) {
        kept.remove();
        throw;
    }
    kept.remove();
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
                      "its steps, seen as `explore` shows them first. It lasts 10 s, or longer "
                      "where there are more steps than frames in 10 s");
    command
        .option("-o,--output,--out FILE", options->out,
                "Movie to write: .mp4, .mkv or .mov (H.264), .webm (VP9), or .gif; or a folder for "
                "its frames (.png); or .jsonl, the film of an index as a recording, which `replay` "
                "plays")
        .required();
    command.option(
        "--isovalue VALUE", options->series.isovalue,
        "With an index: isovalue of the surface (default: the one that `explore` shows first)");
    command.option("--steps,--step FIRST:LAST[:STRIDE]", options->series.steps,
                   "With an index: steps to show, numbered from 0: `0:63` for 0 to 63, or `0:63:4` "
                   "for every fourth of them (default: all)");
    command
        .option(
            "--between MODE", options->series.between,
            "With an index: what to show between two steps: `hold` shows the step before, `blend` "
            "a blend of both (default: what `isochron info` advises)")
        .one_of(interaction::all_names<interaction::BetweenSteps>());
    command.option("--keys FILE", options->series.keys,
                   "With an index: file of the key frames that the film goes through "
                   "(docs/FORMATS.md), or a session that has "
                   "keys (Ctrl + M in `explore`)");
    command
        .option(
            "--film FILM", options->series.film,
            "With an index: the kind of film, `time` (the steps pass), `turn` (one turn about the "
            "data's up axis while the first of the steps stands) or `both` (one turn while the "
            "steps pass) (default: time)")
        .one_of({"time", "turn", "both"});
    command.flag("--turn", options->series.turn,
                 "One turn while time plays, as `--film both` makes it. With `--steps 5`, step 5 "
                 "stands still during the turn");
    command
        .option("--length SECONDS", options->series.length,
                "With an index: length of the turn (default: 10)")
        .between(0.1, interaction::kLongestFilm);
    command.flag("--titles", options->series.titles,
                 "Show the name and the text of each key at the bottom while the film rests there: "
                 "with --keys, or with the recording of a film or story whose keys have texts");
    command.flag("--panorama", options->panorama,
                 "All directions for both eyes: equirectangular, the left eye's picture above the "
                 "right eye's, in a square of 4096 pixels, or as --size says");
    command.option("--rate RATE", options->rate, "Frames per second").positive().shows_default();
    command
        .option("--eyes EYES", options->eyes,
                "`window` makes one movie of what the window shows; `each` makes a movie for each "
                "eye of each viewport and adds their names to the name of --output")
        .one_of({"window", "each"})
        .shows_default();
    command.flag("--force", options->force, "Replace a movie that exists");
    command.flag(
        "--background", options->background,
        "Work as the panel's movies do: at low priority, with progress in lines on stdout, "
        "and only as long as the program that started this one runs");
    command.footer(
        "Each frame is drawn for its time in the movie. `replay --every` writes single "
        "pictures. While a movie is made, its pictures are kept in a hidden folder beside "
        "it; if the command is ended before, the same command goes on with them.");
    command.on_run(
        [options] { run_in_cluster([&](ClusterJob& job) { make_movie(*options, job); }); });
}

} // namespace isochron::app
