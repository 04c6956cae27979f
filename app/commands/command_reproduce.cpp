// `isochron reproduce`: draws a picture again from the note inside it, and compares the two.
#include "app/command_line/subcommands.h"
#include "app/config/config_words.h"
#include "app/explore/figure_page.h"
#include "app/explore/kept_session.h"
#include "app/explore/replay_source.h"
#include "app/indexing/open_index.h"
#include "app/loop/replay.h"
#include "app/output/guarded_outputs.h"
#include "app/output/picture_parts.h"
#include "app/telling.h"
#include "app/version.h"
#include "index/error.h"
#include "index/shell_word.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "stereo/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <tuple>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
    std::string picture;
    std::optional<std::string> data, out;
    std::string context = "egl";
    bool force = false, any_data = false;
    std::vector<std::string> models; ///< files of triangles that may be opened
};

PictureNote note_in(const fs::path& picture) {
    const std::string text = note_text_in(picture);
    if (text.empty())
        throw interaction::Error("{}: it has no note of what it shows: isochron has not written "
                                 "it, or another program has saved it again",
                                 picture.string());
    try {
        return note_from(text);
    } catch (const interaction::Error& error) {
        throw interaction::Error("{}: {}", picture.string(), error.what());
    }
}

/// The data that the options name, else the file that the picture's note names: beside the picture
/// or in the working directory.
fs::path data_path(const ReproduceOptions& options, const PictureNote& note) {
    if (options.data)
        return *options.data;
    std::error_code ignored;
    for (const fs::path& path :
         {fs::path(options.picture).parent_path() / note.data, fs::path(note.data)})
        if (!note.data.empty() && fs::is_regular_file(path, ignored))
            return path;
    throw interaction::Error("{}: it shows {} (hash {}), which is not in the picture's folder; "
                             "give its path with --data",
                             options.picture, note.data, note.data_hash);
}

Config config_for(const ReproduceOptions& options, const PictureNote& note) {
    Config config = parse_config(note.configuration, options.picture + " (configuration)");
    config.rendering.context = *stereo::context_kind_from_name(options.context);
    config.pictures.samples = note.samples;
    config.pictures.passes = note.passes;
    config.pictures.ray = note.ray;
    config.pictures.caption = note.caption;
    config.pictures.text = static_cast<float>(note.text);
    config.rendering.cell_shape = value_of<render::CellShape>(note.shape, "shape");
    config.openxr.enabled = false;
    if (note.footprint != render::name_of(render::Footprint::quad))
        config.quality.settled =
            value_of<SettledFootprint>(note.footprint, "footprint", kSettledField);
    auto& windows = config.installation.windows;
    for (stereo::Window& window : windows)
        window.fullscreen = false;
    if (note.part.shows != "room") {
        if (note.part.window >= windows.size())
            throw interaction::Error("{}: it shows window {} of {}", options.picture,
                                     note.part.window + 1, windows.size());
        windows[note.part.window].size = note.size;
    }
    return config;
}

stereo::Windows windows_for(const Config& config, const PictureNote& note) {
    if (note.part.shows == "room")
        return stereo::open_room(config.rendering.context, config.installation,
                                 {.size = note.size});
    return stereo::open_windows(config.rendering.context, config.installation, {});
}

/// Repeats the frame with the same devices until the picture has its final quality.
void settle(Session& session, const PictureNote& note) {
    constexpr int kMost = 100;
    interaction::InputState input = note.input;
    const Latch latch = note.latched.devices.empty() ? Latch{} : [&note] { return note.latched; };
    for (int i = 0; i < kMost; ++i) {
        const FrameReport& frame = session.frame(input, {}, Waiting::for_cells, latch);
        expect_cells(session);
        if (frame.final && name_of(frame.footprint) == note.footprint && !frame.redrawn)
            return;
        input.time += interaction::Seconds(0.1);
    }
}

struct MadePicture {
    render::Image image;
    std::string drawn_with;
    std::vector<std::string> differs; ///< parts of the data and the program that differ
};

MadePicture make(const ReproduceOptions& options, const PictureNote& note) {
    const Config config = config_for(options, note);
    const fs::path data = data_path(options, note);
    const auto file = open_index_to_show(data, config.memory.cache_bytes());
    if (options.out)
        guard_outputs({{*options.out, OutputKind::picture}}, {{options.picture, data}, file.get()},
                      options.force);
    MadePicture made;
    if (const std::string other = other_reading(options.picture, note.reading, *file);
        !other.empty())
        print_note("{}", other);
    if (data_hash_of(*file) != note.data_hash) {
        if (!options.any_data)
            throw interaction::Error("{}: made of other data: expected hash {}, {} has {} "
                                     "(--any-data draws them and counts the pixels that differ)",
                                     options.picture, note.data_hash, data.string(),
                                     data_hash_of(*file));
        made.differs.push_back(fmt::format("data: hash {}, {} has {}", note.data_hash,
                                           data.string(), data_hash_of(*file)));
    }
    Session session(config, file, windows_for(config, note));
    ExplorerState state = session.state();
    for (const std::string& refused : state.refusals(note.state, file->info().steps())) {
        if (!options.any_data)
            throw interaction::Error(
                "{}: its state does not fit the data: {} (--any-data goes on without)",
                options.picture, refused);
        made.differs.push_back("state: " + refused);
    }
    state.resume(note.state, file->info().steps());
    if (note.footprint == render::name_of(render::Footprint::quad))
        state.quality = interaction::QualityMode::fast;
    session.set_state(state);
    session.models().add_folder(fs::path(options.picture).parent_path());
    for (const std::string& model : options.models)
        session.models().allow(fs::absolute(model));
    session.set_title({note.title, static_cast<float>(note.opacity)});
    settle(session, note);
    for (const std::string& fault : session.models().faults())
        made.differs.push_back(fault);
    const PictureNames names = picture_names(config.installation);
    const bool each_eye =
        note.part.shows == "left" || note.part.shows == "right" || note.part.shows == "center";
    each_part(session.outputs(), each_eye, names, session.note(),
              [&](const PictureNote& mine, const std::string&, render::Image image) {
                  if (mine.part == note.part) {
                      made.image = std::move(image);
                      made.drawn_with = mine.drawn_with;
                  }
              });
    if (made.image.rgba.empty())
        throw interaction::Error("{}: it shows a {} that its configuration does not have",
                                 options.picture, note.part.shows);
    return made;
}

/// What differs between two pictures, in words; nothing if their pixels are the same.
std::vector<std::string> differences(const PictureNote& note, const MadePicture& made,
                                     const render::Image& there) {
    std::vector<std::string> lines;
    if (note.program != kProgram)
        lines.push_back(fmt::format("program: {}, this is {}", note.program, kProgram));
    if (note.drawn_with != made.drawn_with)
        lines.push_back(fmt::format("driver: {}, here {}", note.drawn_with, made.drawn_with));
    if (there.width != made.image.width || there.height != made.image.height) {
        lines.insert(lines.begin(), made.differs.begin(), made.differs.end());
        lines.push_back(fmt::format("size: {} x {}, made again {} x {}", there.width, there.height,
                                    made.image.width, made.image.height));
        return lines;
    }
    std::size_t pixels = 0, first = 0;
    int most = 0;
    for (std::size_t i = 0; i < there.rgba.size(); i += 4) {
        int off = 0;
        for (std::size_t c = 0; c < 3; ++c)
            off = std::max(off, std::abs(there.rgba[i + c] - made.image.rgba[i + c]));
        if (off > 0 && pixels++ == 0)
            first = i / 4;
        most = std::max(most, off);
    }
    if (pixels == 0)
        return made.differs;
    lines.insert(lines.begin(), made.differs.begin(), made.differs.end());
    lines.push_back(
        fmt::format("pixels: {} of {} differ, by at most {} of 255, the first at {}, {}", pixels,
                    there.rgba.size() / 4, most, first % static_cast<std::size_t>(there.width),
                    first / static_cast<std::size_t>(there.width)));
    return lines;
}

void describe(const std::string& picture, const PictureNote& note) {
    tell_result({{"picture", picture},
                 {"shows", note.part.shows},
                 {"data", note.data},
                 {"data_hash", note.data_hash},
                 {"program", note.program},
                 {"equal", false}}); // until it is known
    print_report("{}: {} of {} (hash {}), by {}\n", picture, note.part.shows, note.data,
                 note.data_hash, note.program);
}

/// Makes a figure again from its record. @return whether the file is one
bool reproduced_figure(const ReproduceOptions& options) {
    const std::string text = figure_note_in(options.picture);
    if (text.empty())
        return false;
    const FigureRecord record = figure_record_from(text);
    const FigureFile figure = parse_figure(record.text, options.picture, record.texts);
    std::vector<fs::path> data;
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        const fs::path beside = fs::path(options.picture).parent_path();
        const std::string& named = i < record.data.size() ? record.data[i] : "";
        data.push_back(beside / figure.panels[i].index);
        std::error_code ignored;
        for (const fs::path& path : {beside / named, fs::path(named)})
            if (!fs::is_regular_file(data.back(), ignored))
                data.back() = path;
        if (options.data)
            data.back() = *options.data;
        const auto file = open_index_to_show(data.back());
        if (i < record.hashes.size() && data_hash_of(*file) != record.hashes[i] &&
            !options.any_data)
            throw interaction::Error("{}: panel {} was made of other data: expected hash {}, {} "
                                     "has {} (--any-data draws them)",
                                     options.picture, i + 1, record.hashes[i], data.back().string(),
                                     data_hash_of(*file));
    }
    print_report("{}: a figure of {} panel{}, by {}\n", options.picture, figure.panels.size(),
                 figure.panels.size() == 1 ? "" : "s", record.program);
    MadeFigure made = make_figure(figure, options.picture, data,
                                  *stereo::context_kind_from_name(options.context));
    const std::string drawn_with = made.record.drawn_with;
    made.page.note = text;
    const auto bytes = figure_bytes(made, figure.dpi, options.picture);
    const std::string there = index::read_text(options.picture, std::uint64_t{1} << 34);
    if (options.out) {
        guard_outputs({{*options.out, OutputKind::picture}}, {{options.picture}, nullptr},
                      options.force);
        index::write_file(*options.out, figure_bytes(made, figure.dpi, *options.out));
        print_report("wrote {}\n", *options.out);
    }
    const bool equal = std::ranges::equal(std::as_bytes(std::span(there)), bytes);
    tell_result({{"picture", options.picture}, {"equal", equal}, {"equal_bytes", equal}});
    if (equal) {
        print_report("made again: the same {} bytes\n", there.size());
        return true;
    }
    for (const auto& [what, then, now] :
         {std::tuple("program", record.program, std::string(kProgram)),
          std::tuple("driver", record.drawn_with, drawn_with)})
        if (then != now)
            print_report("differs: {}: {}, here {}\n", what, then, now);
    throw interaction::Error(options.picture + ": made again, it differs");
}

void reproduce(const ReproduceOptions& options) {
    if (reproduced_figure(options))
        return;
    const PictureNote note = note_in(options.picture);
    describe(options.picture, note);
    if (note.movie)
        throw interaction::Error(
            "{}: a movie is made again by `isochron movie {} --rate {} -o MOVIE{}{}`, of the {}",
            options.picture, note.movie->recording.empty() ? "INDEX" : "RECORDING",
            note.movie->rate,
            options.data && !note.movie->recording.empty()
                ? " --data " + index::shell_word(*options.data)
                : "",
            options.any_data ? " --any-data" : "",
            note.movie->recording.empty()
                ? fmt::format("data with hash {}", note.data_hash)
                : fmt::format("recording with hash {}", note.movie->recording));
    for (const auto& [shows, words] : {std::pair("headset", "a headset's mirror"),
                                       std::pair("panorama", "a panorama of many views")})
        if (note.part.shows == shows)
            throw interaction::Error("{}: it shows {}, which is not made again", options.picture,
                                     words);
    MadePicture made = make(options, note);
    const auto bytes = stereo::encoded_image(made.image, options.picture, text_of(note));
    constexpr std::uint64_t kLargest = std::uint64_t{1} << 34;
    const std::string there = index::read_text(options.picture, kLargest);
    if (options.out) {
        index::write_file(*options.out,
                          stereo::encoded_image(made.image, *options.out, text_of(note)));
        tell_result({{"output", *options.out}});
        print_report("wrote {}\n", *options.out);
    }
    const std::string_view mine(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (mine == there && made.differs.empty()) {
        tell_result({{"equal", true}, {"equal_bytes", true}});
        print_report("made again: the same {} bytes\n", there.size());
        return;
    }
    // With what the format loses. Alpha is neither written nor compared.
    made.image = stereo::decoded_image(bytes, options.picture);
    const auto lines = differences(note, made, stereo::read_image(options.picture));
    if (lines.empty()) {
        tell_result({{"equal", true}, {"equal_bytes", false}});
        print_report("made again: the same pixels, which the file stores in other bytes\n");
        return;
    }
    tell_result({{"differences", lines}});
    for (const std::string& line : lines)
        print_report("differs: {}\n", line);
    throw interaction::Error(options.picture + ": made again, it differs");
}

} // namespace

void add_reproduce(Command& program) {
    auto options = std::make_shared<ReproduceOptions>();
    Command command = program.subcommand(
        "reproduce",
        "Draw a saved picture again from the settings that it holds, and compare both.");
    command.examples(
        {"isochron reproduce pictures/stamp_00012_stamp-1.png",
         "isochron reproduce pictures/stamp_00012_stamp-1.png --data run42.isochron -o again.png"});
    command
        .option("picture FILE", options->picture,
                "Picture (.png, .exr, .tiff or .jpg) or figure (.pdf, .png or .tiff) that isochron "
                "wrote")
        .required();
    command.option(
        "--data INDEX", options->data,
        "Index to draw (default: the one that the picture names, beside the picture or in "
        "the working directory)");
    command.option(
        "--model FILE", options->models,
        "Let the picture show this file of triangles, though it lies outside of the folders "
        "of picture and data; may be given several times");
    command.option("-o,--output,--out FILE", options->out, "Save the new picture in this file");
    command.flag("--force", options->force,
                 "Let --output replace any file but one that is read; without this option it "
                 "replaces only pictures of this program");
    command.flag(
        "--any-data", options->any_data,
        "Draw the data even if they differ from those of the picture, as their hashes tell, "
        "and count the pixels that differ");
    command.option("--context CONTEXT", options->context, "OpenGL context to draw with")
        .one_of({"egl", "osmesa"})
        .shows_default();
    command.footer("The command prints that the pictures are equal, or what differs: the data, the "
                   "program, the driver, and how many pixels.");
    command.exit_status(0, "equal pictures");
    command.exit_status(1, "different pictures or bad input");
    command.on_run([options] { reproduce(*options); });
}

} // namespace isochron::app
