// Writes movies as pictures in a folder.
#include "app/output/movie_file.h"
#include "index/error.h"
#include "index/system/new_file.h"
#include "stereo/image_file.h"

#include <fmt/format.h>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

bool is_frame(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("frame_") && file.extension() == ".png";
}

} // namespace

MovieFolder::MovieFolder(fs::path path)
    : path_(index::end_of_links(std::move(path))), temporary_(path_),
      pictures_(temporary_.path() / "pictures") { // with the rights of any folder
    index::make_folder(pictures_);
}

MovieFolder::~MovieFolder() = default;

void MovieFolder::add(const render::Image& image, const std::string& note) {
    const glm::ivec2 size(image.width, image.height);
    if (frames_ > 0 && size != size_)
        throw index::Error(fmt::format("{}: a picture of {} x {}, the movie has {} x {}",
                                       path_.string(), size.x, size.y, size_.x, size_.y));
    size_ = size;
    stereo::write_image(image, pictures_ / fmt::format("frame_{:05}.png", frames_), note);
    ++frames_;
}

void MovieFolder::finish() {
    std::error_code error;
    fs::rename(pictures_, path_, error); // where nothing is, or an empty folder: all or nothing
    if (!error)
        return;
    if (!fs::is_directory(path_))
        throw index::Error(fmt::format("{}: {}", path_.string(), error.message()));
    error.clear();
    for (const fs::directory_entry& entry : fs::directory_iterator(path_, error))
        if (is_frame(entry.path()))
            fs::remove(entry.path(), error);
    for (std::size_t i = 0; i < frames_ && !error; ++i) {
        const std::string name = fmt::format("frame_{:05}.png", i);
        fs::rename(pictures_ / name, path_ / name, error);
    }
    if (error)
        throw index::Error(fmt::format("{}: {}", path_.string(), error.message()));
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
