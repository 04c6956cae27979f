// A movie that is written picture by picture: by the program ffmpeg, or as a folder of pictures.
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

/// The file or folder appears under its name when it is whole; destroyed before that, nothing is
/// left of it. Used by one thread at a time.
class Movie {
  public:
    virtual ~Movie() = default;
    /// @param note kept with the picture, where each has a place for its own; ASCII, empty: none
    /// @throws index::Error when the picture has another size or cannot be written
    virtual void add(const render::Image& image, const std::string& note = {}) = 0;
    virtual std::size_t frames() const = 0; ///< added so far
    /// @throws index::Error when it cannot be completed
    virtual void finish() = 0;
};

/// What its name says that it is: `.gif`, else H.264 in what ffmpeg makes of the suffix.
class MovieFile final : public Movie {
  public:
    /// @param size of every picture, pixels
    /// @param rate pictures per second
    /// @param note kept in the file, where its format has a place for it; ASCII, empty: none
    /// @param hurried larger files in a third of the time, where drawing needs the same processors
    /// @throws index::Error when ffmpeg is missing or cannot be started
    MovieFile(std::filesystem::path path, glm::ivec2 size, double rate, std::string note = {},
              bool hurried = false);
    ~MovieFile() override;
    MovieFile(const MovieFile&) = delete;
    MovieFile& operator=(const MovieFile&) = delete;

    /// Also throws what ffmpeg complained of. The file keeps one note, that of its start.
    void add(const render::Image& image, const std::string& note = {}) override;
    std::size_t frames() const override;
    void finish() override;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// `frame_00000.png` and so on in a folder.
class MovieFolder final : public Movie {
  public:
    /// @param path its frames of an earlier movie are replaced when this one is whole
    /// @throws index::Error when the folder beside it, in which it grows, cannot be made
    explicit MovieFolder(std::filesystem::path path);
    ~MovieFolder() override;
    MovieFolder(const MovieFolder&) = delete;
    MovieFolder& operator=(const MovieFolder&) = delete;

    void add(const render::Image& image, const std::string& note = {}) override;
    std::size_t frames() const override { return frames_; }
    void finish() override;

  private:
    std::filesystem::path path_, temporary_;
    glm::ivec2 size_{0};
    std::size_t frames_ = 0;
};

/// Whether a movie of that name is a folder: it has no suffix.
bool is_movie_folder(const std::filesystem::path& path);
/// Whether something is there that a movie of that name would replace.
bool holds_movie(const std::filesystem::path& path);

} // namespace isochron::app
