// The note inside a written picture: what the picture shows, the data, and all settings that are
// needed to draw it again.
#pragma once

#include "interaction/recording/recorded_frame.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace isochron::app {

/// Which picture of a frame it is.
struct PicturePart {
    /// `window`: as its stereo mode composes it; `right_buffer` of a window; `left`, `right` or
    /// `center`: the picture of one eye; `room`: the emulated room; `headset`: a headset's mirror.
    std::string shows = "window";
    std::size_t window = 0;   ///< number of the installation's window
    std::size_t viewport = 0; ///< number of the window's viewport, for an eye's own picture
    bool operator==(const PicturePart&) const = default;
};

/// How a movie continues after its first frame, which the note describes.
struct MovieNote {
    double rate = 0;       ///< pictures per second
    std::string recording; ///< content hash of the recording; empty: made of an index
    bool operator==(const MovieNote&) const = default;
};

struct PictureNote {
    std::string program;       ///< `isochron 0.1.0`
    std::string drawn_with;    ///< the driver; one line
    std::string configuration; ///< the whole text of the configuration file
    std::string data;          ///< file name of the index, without its folder
    std::string data_hash;     ///< hexadecimal content hash
    std::string recorded_on{}; ///< hash of the recording's data, if those are others
    std::uint32_t reading = 0; ///< `index::Metadata::reading_number` of the data; 0: not said
    PicturePart part;
    glm::ivec2 size{0};    ///< size of the window or room, pixels
    int samples = 1;       ///< samples of each pixel
    int passes = 1;        ///< pictures, each of other samples, whose mean it is
    std::string footprint; ///< name of the footprint that cells are drawn with
    std::string shape;     ///< shape of quads and splats
    bool ray = false;      ///< shows the wand's ray and the mark under the cursor
    bool caption = false;
    double text = 0;                  ///< height of words, see `text_height`
    std::string title{};              ///< words over the picture; empty: none
    double opacity = 0;               ///< opacity of these words, 0 to 1
    interaction::Commands state;      ///< sets everything that commands can set
    interaction::InputState input;    ///< devices
    interaction::InputState latched;  ///< heads for the views; without devices: those in `input`
    std::optional<MovieNote> movie{}; ///< empty: a single picture
    /// The windows show just what is kept. It is not part of the text.
    bool as_seen = true;
    bool operator==(const PictureNote&) const = default;
};

/// The note as one line of ASCII.
std::string text_of(const PictureNote& note);
/// The note of a picture that shows the test pattern: only by whom it was written.
std::string note_of_test_pattern();
/// The note of the figure of a configuration, alike.
std::string note_of_room_plan();
/// Parses a note. @throws interaction::Error, which does not name the file: none, of a test pattern,
/// ...
PictureNote note_from(const std::string& text);

/// The text of the note in a picture or movie; empty if it has none.
/// @throws index::Error, render::Error naming the file
std::string note_text_in(const std::filesystem::path& path);

/// Puts a note into a GIF file, as ffmpeg does not.
/// @throws index::Error when the file is no GIF
void add_note_to_gif(const std::filesystem::path& path, const std::string& text);

} // namespace isochron::app
