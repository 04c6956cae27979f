// A movie that is written picture by picture, by the program ffmpeg.
//
//     MovieFile movie("walk.mp4", {1280, 720}, 30);
//     movie.add(image);      // one for each frame of the movie
//     movie.finish();        // and it has its name
#pragma once

#include "render/gl/image.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace isochron::app {

/// What a movie's name says that it is: `.gif`, else H.264 in what ffmpeg makes of the suffix.
/// The file appears under its name when it is whole; destroyed before that, nothing is left of it.
/// Used by one thread at a time.
class MovieFile {
  public:
    /// @param size of every picture, pixels
    /// @param rate pictures per second
    /// @param note kept in the file, where its format has a place for it; ASCII, empty: none
    /// @throws index::Error when ffmpeg is missing or cannot be started
    MovieFile(std::filesystem::path path, glm::ivec2 size, double rate, std::string note = {});
    ~MovieFile();
    MovieFile(const MovieFile&) = delete;
    MovieFile& operator=(const MovieFile&) = delete;

    /// @throws index::Error when the picture has another size, or with what ffmpeg complained of
    void add(const render::Image& image);
    std::size_t frames() const; ///< added so far
    /// @throws index::Error with what ffmpeg complained of
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::app
