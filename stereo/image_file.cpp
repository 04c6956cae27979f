// Reads and writes pictures through the module that handles their formats.
#include "stereo/image_file.h"

#include "index/system/module.h"
#include "index/system/new_file.h"
#include "render/gl/gl.h"
#include "stereo/image_module/image_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace isochron::stereo {
namespace {

constexpr const char* kModule = "isochron_images";

template <typename Function>
Function* module_function(const char* name) {
    return reinterpret_cast<Function*>(index::module_symbol(kModule, name));
}

/// The format of a path, `png` or `exr`. @throws render::Error for anything else
std::string format_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != ".png" && extension != ".exr")
        throw render::Error(fmt::format("{}: pictures are written as .png or .exr, not as '{}'",
                                        path.string(), extension));
    return extension.substr(1);
}

} // namespace

std::vector<std::byte> encoded_image(const render::Image& image, const std::filesystem::path& path,
                                     const std::string& note) {
    const std::string format = format_of(path);
    const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) *
                        static_cast<std::size_t>(std::max(image.height, 0));
    if (pixels == 0 || image.rgba.size() != 4 * pixels)
        throw render::Error(fmt::format("{}: a picture of {}x{} pixels with {} bytes cannot be "
                                        "written",
                                        path.string(), image.width, image.height,
                                        image.rgba.size()));
    static const auto encode = module_function<image_module::Encode>(image_module::kEncode);
    std::vector<std::byte> bytes;
    std::string error;
    encode(image, format, note, bytes, error);
    if (!error.empty())
        throw render::Error(fmt::format("{}: {}", path.string(), error));
    return bytes;
}

void write_image(const render::Image& image, const std::filesystem::path& path,
                 const std::string& note) {
    const std::vector<std::byte> bytes = encoded_image(image, path, note);
    index::NewFile file(path);
    file.write_at(0, bytes);
    file.commit();
}

std::string read_note(const std::filesystem::path& path) {
    static const auto read = module_function<image_module::ReadNote>(image_module::kReadNote);
    std::string note, error;
    read(path.string(), note, error);
    if (!error.empty())
        throw render::Error(fmt::format("{}: {}", path.string(), error));
    return note;
}

render::Image read_image(const std::filesystem::path& path) {
    static const auto decode = module_function<image_module::Decode>(image_module::kDecode);
    render::Image image;
    std::string error;
    decode(path.string(), image, error);
    if (!error.empty())
        throw render::Error(fmt::format("{}: {}", path.string(), error));
    return image;
}

} // namespace isochron::stereo
