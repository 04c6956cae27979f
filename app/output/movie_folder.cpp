// Writes movies as pictures in a folder.
#include "app/output/movie_file.h"
#include "index/error.h"
#include "index/system/new_file.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

const char* const kFrameStart = "frame_"; ///< how the names of all frames begin

std::string name_of(std::size_t frame) {
    return fmt::format("{}{:05}.png", kFrameStart, frame);
}

bool is_frame(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with(kFrameStart) && file.extension() == ".png";
}

/// The path of a folder without a slash at its end.
fs::path without_slash(const fs::path& folder) {
    return folder.has_filename() ? folder : folder.parent_path();
}

} // namespace

MovieFolder::MovieFolder(const fs::path& path)
    : path_(index::end_of_links(without_slash(path))), temporary_(path_, kFrameStart) {}

MovieFolder::~MovieFolder() = default;

void MovieFolder::add(const render::Image& image, const std::string& note) {
    const glm::ivec2 size(image.width, image.height);
    if (frames_ > 0 && size != size_)
        throw index::Error("{}: a picture of {} x {}, the movie has {} x {}", path_.string(),
                           size.x, size.y, size_.x, size_.y);
    size_ = size;
    stereo::write_image(image, temporary_.path() / name_of(frames_), note);
    ++frames_;
}

void MovieFolder::finish() {
    std::error_code error = temporary_.take_name(path_);
    if (!error)
        return;
    if (!fs::is_directory(path_))
        throw index::Error("{}: {}", path_.string(), error.message());
    error.clear();
    for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
        if (is_frame(entry.path()))
            fs::remove(entry.path(), error);
    for (std::size_t i = 0; i < frames_ && !error; ++i) {
        const std::string name = name_of(i);
        fs::rename(temporary_.path() / name, path_ / name, error);
    }
    if (error)
        throw index::Error("{}: {}", path_.string(), error.message());
}

bool is_movie_folder(const fs::path& path) {
    return path.extension().empty();
}

bool holds_movie(const fs::path& path) {
    std::error_code error;
    if (!is_movie_folder(path) || !fs::is_directory(path, error))
        return fs::exists(path, error);
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
        if (is_frame(entry.path()))
            return true;
    return false;
}

} // namespace isochron::app
