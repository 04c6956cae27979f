// Writes a movie picture by picture: through the program ffmpeg, or as a folder of pictures.
//
//     MovieFile movie("walk.mp4", {1280, 720}, 30);
//     movie.add(image);      // one for each frame of the movie
//     movie.finish();        // and it has its name
#pragma once

#include "index/system/temporary/temporary_folder.h"
#include "render/gl/image.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace isochron::app {

/// A movie that is being written. `finish` gives the complete file or folder its name; without
/// `finish` nothing is left of it. Used by one thread at a time.
class Movie {
  public:
    virtual ~Movie() = default;
    /// Adds a picture.
    /// @param note stored with the picture if the format has a note for each; ASCII, empty: none
    /// @throws index::Error when the picture has another size or cannot be written
    virtual void add(const render::Image& image, const std::string& note = {}) = 0;
    virtual std::size_t frames() const = 0; ///< added so far
    /// Completes the movie. @throws index::Error when that fails
    virtual void finish() = 0;
};

/// A movie in one file. The suffix says the format: `.gif`, `.webm` with VP9, else H.264 in the
/// container that ffmpeg chooses for it.
class MovieFile final : public Movie {
  public:
    /// @param size of every picture, pixels
    /// @param rate pictures per second
    /// @param note stored in the file if its format has a place for it; ASCII, empty: none
    /// @param hurried encodes in a third of the time into larger files: for drawing in software,
    /// which needs the same processors
    /// @throws index::Error when ffmpeg is missing or cannot be started
    MovieFile(std::filesystem::path path, glm::ivec2 size, double rate, std::string note = {},
              bool hurried = false);
    ~MovieFile() override;
    MovieFile(const MovieFile&) = delete;
    MovieFile& operator=(const MovieFile&) = delete;

    /// Also throws ffmpeg's error messages. Ignores `note`: the file has one note, from the start.
    void add(const render::Image& image, const std::string& note = {}) override;
    std::size_t frames() const override;
    void finish() override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A movie as `frame_00000.png` and so on in a folder.
class MovieFolder final : public Movie {
  public:
    /// @param path folder; when this movie is complete it replaces the frames of an earlier one
    /// @throws index::Error when the temporary folder beside it cannot be made
    explicit MovieFolder(const std::filesystem::path& path);
    ~MovieFolder() override;
    MovieFolder(const MovieFolder&) = delete;
    MovieFolder& operator=(const MovieFolder&) = delete;

    void add(const render::Image& image, const std::string& note = {}) override;
    std::size_t frames() const override { return frames_; }
    void finish() override;

  private:
    std::filesystem::path path_;
    index::TemporaryFolder temporary_;
    glm::ivec2 size_{0};
    std::size_t frames_ = 0;
};

/// Whether a movie with this name is a folder: the name has no suffix, or ends in a slash.
bool is_movie_folder(const std::filesystem::path& path);
/// Whether a movie with this name would replace an existing file, or frames in a folder.
bool holds_movie(const std::filesystem::path& path);

} // namespace isochron::app
