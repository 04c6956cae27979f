// Converts the notes in pictures to text and back.
#include "app/output/picture_note.h"

#include "index/json_mistake.h"

#include "index/error.h"
#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/json_values.h"
#include "interaction/recording/recording_json.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

namespace isochron::app {
namespace {

using nlohmann::json;

constexpr const char* kNoteFormat = "isochron picture";
constexpr std::uint64_t kNoteVersion = 1, kLargestWindow = 1 << 20, kMostParts = 1 << 16;
/// Marks around the text in files whose structure is not parsed.
constexpr std::string_view kBegin = "<isochron-picture>", kEnd = "</isochron-picture>";

json part_json(const PicturePart& part) {
    return {{"shows", part.shows}, {"window", part.window}, {"viewport", part.viewport}};
}

PicturePart part_from(const json& value) {
    interaction::Members members(value, "part");
    PicturePart part;
    part.shows = interaction::text(members.at("shows"), "shows");
    part.window = interaction::natural(members.at("window"), "window", kMostParts);
    part.viewport = interaction::natural(members.at("viewport"), "viewport", kMostParts);
    members.done({"shows", "window", "viewport"});
    return part;
}

MovieNote movie_from(const json& value) {
    interaction::Members members(value, "movie");
    MovieNote movie;
    movie.rate = interaction::number(members.at("rate"), "rate", 1e-3, 1e4);
    movie.recording = interaction::text(members.at("recording"), "recording");
    members.done({"rate", "recording"});
    return movie;
}

glm::ivec2 size_from(const json& value) {
    const json& list = interaction::list(value, "size", 2, 2);
    return {interaction::natural(list[0], "size", kLargestWindow),
            interaction::natural(list[1], "size", kLargestWindow)};
}

std::string note_without_data(const char* shows) {
    const json value{{"format", kNoteFormat}, {"version", kNoteVersion}, {shows, true}};
    return fmt::format("{}{}{}", kBegin, value.dump(), kEnd);
}

PictureNote note_from_json(const json& value) {
    interaction::Members members(value, "picture");
    if (interaction::text(members.at("format"), "format") != kNoteFormat)
        throw interaction::Error("expected format \"{}\"", kNoteFormat);
    interaction::natural(members.at("version"), "version", kNoteVersion);
    if (members.find("test_pattern"))
        throw interaction::Error(
            "it shows the test pattern, which `isochron replay --test-pattern` draws");
    if (members.find("room_plan"))
        throw interaction::Error("it shows a configuration, which `isochron explore --check-config "
                                 "FILE --picture` draws");
    const auto text = [&](const char* key) { return interaction::text(members.at(key), key); };
    PictureNote note;
    note.program = text("program");
    note.drawn_with = text("drawn_with");
    note.configuration = text("configuration");
    note.data = text("data");
    note.data_hash = text("data_hash");
    if (const json* other = members.find("recorded_on"))
        note.recorded_on = interaction::text(*other, "recorded_on");
    if (const json* reading = members.find("reading_number"))
        note.reading = static_cast<std::uint32_t>(interaction::natural(
            *reading, "reading_number", std::numeric_limits<std::uint32_t>::max()));
    note.part = part_from(members.at("part"));
    note.size = size_from(members.at("size"));
    note.samples = static_cast<int>(interaction::natural(members.at("samples"), "samples", 64));
    if (const json* passes = members.find("passes"))
        note.passes = static_cast<int>(interaction::natural(*passes, "passes", 64));
    note.footprint = text("footprint");
    note.shape = text("shape");
    note.ray = interaction::boolean(members.at("ray"), "ray");
    note.caption = interaction::boolean(members.at("caption"), "caption");
    if (const json* share = members.find("text"))
        note.text = interaction::number(*share, "text", 0, 1);
    if (const json* title = members.find("title")) {
        note.title = interaction::text(*title, "title");
        note.opacity = interaction::number(members.at("title_opacity"), "title_opacity", 0, 1);
    }
    note.state = interaction::commands_from(members.at("state"), "state");
    const auto frame = interaction::frame_from_json(members.at("frame"), nullptr);
    note.input = frame.input;
    interaction::take_old_bits(note.input); // for a picture from before the names of actions
    note.latched = frame.latched;
    if (const json* movie = members.find("movie"))
        note.movie = movie_from(*movie);
    members.done({"format",         "version",   "program",      "drawn_with", "configuration",
                  "data",           "data_hash", "part",         "size",       "samples",
                  "passes",         "footprint", "shape",        "ray",        "caption",
                  "text",           "state",     "frame",        "movie",      "recorded_on",
                  "reading_number", "title",     "title_opacity"});
    return note;
}

/// The text of a GIF's last comment, which is stored in blocks of at most 255 bytes.
std::string last_comment(const std::string& bytes) {
    const std::string intro{'\x21', '\xfe'};
    for (std::size_t at = bytes.rfind(intro); at != std::string::npos && at > 0;
         at = bytes.rfind(intro, at - 1)) {
        std::string text;
        std::size_t block = at + intro.size();
        while (block < bytes.size() && bytes[block] != 0) {
            const std::size_t length = static_cast<unsigned char>(bytes[block]);
            text += bytes.substr(block + 1, length);
            block += 1 + length;
        }
        if (text.starts_with(kBegin))
            return text;
    }
    return {};
}

std::string between_marks(const std::string& bytes) {
    const std::size_t begin = bytes.find(kBegin);
    const std::size_t end = begin == std::string::npos ? begin : bytes.find(kEnd, begin);
    if (end == std::string::npos)
        return {};
    return bytes.substr(begin + kBegin.size(), end - begin - kBegin.size());
}

} // namespace

std::string text_of(const PictureNote& note) {
    json value{{"format", kNoteFormat},
               {"version", kNoteVersion},
               {"program", note.program},
               {"drawn_with", note.drawn_with},
               {"configuration", note.configuration},
               {"data", note.data},
               {"data_hash", note.data_hash},
               {"part", part_json(note.part)},
               {"size", {note.size.x, note.size.y}},
               {"samples", note.samples},
               {"footprint", note.footprint},
               {"shape", note.shape},
               {"ray", note.ray},
               {"caption", note.caption},
               {"state", interaction::commands_json(note.state)},
               {"frame", interaction::to_json(interaction::RecordedFrame{.input = note.input,
                                                                         .commands = {},
                                                                         .from_panel = {},
                                                                         .latched = note.latched},
                                              nullptr)}};
    if (note.passes > 1)
        value["passes"] = note.passes;
    if (note.text > 0)
        value["text"] = note.text;
    if (!note.title.empty()) {
        value["title"] = note.title;
        value["title_opacity"] = note.opacity;
    }
    if (note.movie)
        value["movie"] = {{"rate", note.movie->rate}, {"recording", note.movie->recording}};
    if (note.reading != 0)
        value["reading_number"] = note.reading;
    if (!note.recorded_on.empty())
        value["recorded_on"] = note.recorded_on;
    return fmt::format("{}{}{}", kBegin, value.dump(-1, ' ', true, json::error_handler_t::replace),
                       kEnd);
}

std::string note_of_test_pattern() {
    return note_without_data("test_pattern");
}

std::string note_of_room_plan() {
    return note_without_data("room_plan");
}

PictureNote note_from(const std::string& text) {
    const std::string inner = between_marks(text);
    try {
        return note_from_json(json::parse(inner));
    } catch (const json::exception& mistake) {
        throw interaction::Error("what it says of itself is damaged: {}",
                                 index::json_mistake(mistake));
    }
}

std::string note_text_in(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::string text;
    if (stereo::is_picture_name(path)) {
        text = stereo::read_note(path);
    } else {
        constexpr std::uint64_t kLargestMovie = std::uint64_t{1} << 34;
        text = index::read_text(path, kLargestMovie);
        if (extension == ".gif")
            text = last_comment(text);
    }
    const std::string inner = between_marks(text);
    return inner.empty() ? inner : fmt::format("{}{}{}", kBegin, inner, kEnd);
}

void add_note_to_gif(const std::filesystem::path& path, const std::string& text) {
    constexpr std::size_t kBlock = 255;
    constexpr char kTrailer = '\x3b';
    std::string bytes = index::read_text(path, std::uint64_t{1} << 34);
    if (!bytes.starts_with("GIF8") || bytes.back() != kTrailer)
        throw index::Error("{}: not a GIF", path.string());
    bytes.pop_back();
    bytes += {'\x21', '\xfe'};
    for (std::size_t at = 0; at < text.size(); at += kBlock) {
        const std::string block = text.substr(at, kBlock);
        bytes += static_cast<char>(static_cast<unsigned char>(block.size()));
        bytes += block;
    }
    bytes += '\0';
    bytes += kTrailer;
    index::write_file(path, std::as_bytes(std::span(bytes)));
}

} // namespace isochron::app
