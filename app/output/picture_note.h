// What a written picture says of itself: what it shows, of which data, and everything that it was
// drawn by, so that it can be made again.
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
    /// `window` as its stereo mode composes it, its `right_buffer`, the `left`, `right` or `center`
    /// eye's own picture, the emulated `room`, or a `headset`'s mirror.
    std::string shows = "window";
    std::size_t window = 0;   ///< of the installation
    std::size_t viewport = 0; ///< of the window, for an eye's own picture
    bool operator==(const PicturePart&) const = default;
};

/// How a movie goes on from the frame that its note describes.
struct MovieNote {
    double rate = 0;       ///< pictures per second
    std::string recording; ///< content hash of the recording
    bool operator==(const MovieNote&) const = default;
};

struct PictureNote {
    std::string program;       ///< `isochron 0.1.0`
    std::string drawn_with;    ///< the driver; one line
    std::string configuration; ///< the whole text of the configuration file
    std::string data;          ///< file name of the index, without its folder
    std::string data_hash;     ///< hexadecimal content hash
    std::string recorded_on{}; ///< hash of the recording's own data, where these are others
    PicturePart part;
    glm::ivec2 size{0};    ///< of the window or room, pixels
    int samples = 1;       ///< of each pixel
    std::string footprint; ///< that cells are drawn with
    std::string shape;     ///< of quads and splats
    bool ray = false;      ///< wand's ray and what is under the cursor are shown
    bool caption = false;
    interaction::Commands state;      ///< everything that commands can set, set
    interaction::InputState input;    ///< devices
    interaction::InputState latched;  ///< heads for the views; no devices: as in `input`
    std::optional<MovieNote> movie{}; ///< empty: a single picture
    bool operator==(const PictureNote&) const = default;
};

/// One line of ASCII.
std::string text_of(const PictureNote& note);
/// @throws interaction::Error without the file's name
PictureNote note_from(const std::string& text);

/// The text of the note in a picture or movie; empty where there is none.
/// @throws index::Error, render::Error naming the file
std::string note_text_in(const std::filesystem::path& path);

/// Puts a note into a GIF, whose writer does not.
/// @throws index::Error when it is none
void add_note_to_gif(const std::filesystem::path& path, const std::string& text);

} // namespace isochron::app
