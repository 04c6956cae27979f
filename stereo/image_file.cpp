// Reads and writes pictures through the module that handles their formats.
#include "stereo/image_file.h"

#include "index/error.h"
#include "index/system/module.h"
#include "index/system/new_file.h"
#include "render/gl/gl.h"
#include "stereo/image_module/image_module.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

namespace isochron::stereo {
namespace {

using image_module::PictureFormat;

/// A function of the picture module. @throws index::Error naming the picture, and the package that
/// is missing where the library of pictures is
template <typename Function>
Function* picture_function(const char* name, const std::filesystem::path& picture) {
    try {
        index::file_of_program("libisochron_images.so");
    } catch (const index::Error& error) {
        throw index::Error(fmt::format("{}: {}", picture.string(), error.what()));
    }
    try {
        return reinterpret_cast<Function*>(index::module_symbol("isochron_images", name));
    } catch (const index::Error& error) {
        throw index::Error(fmt::format("{}: pictures need the package {}: {}", picture.string(),
                                       ISOCHRON_PICTURE_PACKAGE, error.what()));
    }
}

std::optional<PictureFormat> format_of(const std::filesystem::path& path) {
    struct Extension {
        std::string_view name;
        PictureFormat format;
    };
    constexpr std::array kExtensions{
        Extension{".png", PictureFormat::png},  Extension{".exr", PictureFormat::exr},
        Extension{".tif", PictureFormat::tiff}, Extension{".tiff", PictureFormat::tiff},
        Extension{".jpg", PictureFormat::jpeg}, Extension{".jpeg", PictureFormat::jpeg}};
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* found = std::ranges::find(kExtensions, extension, &Extension::name);
    return found == kExtensions.end() ? std::nullopt : std::optional(found->format);
}

/// @throws render::Error naming the picture, if the module says one
void check(const std::string& error, const std::filesystem::path& picture) {
    if (!error.empty())
        throw render::Error(fmt::format("{}: {}", picture.string(), error));
}

} // namespace

bool is_picture_name(const std::filesystem::path& path) {
    return format_of(path).has_value();
}

std::vector<std::byte> encoded_image(const render::Image& image, const std::filesystem::path& path,
                                     const std::string& note) {
    const std::optional<PictureFormat> format = format_of(path);
    if (!format)
        throw render::Error(fmt::format("{}: pictures are written as .png, .exr, .tiff or .jpg, "
                                        "not as '{}'",
                                        path.string(), path.extension().string()));
    const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) *
                        static_cast<std::size_t>(std::max(image.height, 0));
    if (pixels == 0 || image.rgba.size() != 4 * pixels)
        throw render::Error(fmt::format("{}: a picture of {}x{} pixels with {} bytes cannot be "
                                        "written",
                                        path.string(), image.width, image.height,
                                        image.rgba.size()));
    static const auto encode = picture_function<image_module::Encode>(image_module::kEncode, path);
    std::vector<std::byte> bytes;
    std::string error;
    encode(image, *format, note, bytes, error);
    check(error, path);
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
    static const auto read =
        picture_function<image_module::ReadNote>(image_module::kReadNote, path);
    std::string note, error;
    read(path.string(), note, error);
    check(error, path);
    return note;
}

render::Image read_image(const std::filesystem::path& path) {
    static const auto read = picture_function<image_module::Read>(image_module::kRead, path);
    render::Image image;
    std::string error;
    read(path.string(), image, error);
    check(error, path);
    return image;
}

render::Image decoded_image(std::span<const std::byte> bytes, const std::filesystem::path& path) {
    static const auto decode = picture_function<image_module::Decode>(image_module::kDecode, path);
    render::Image image;
    std::string error;
    decode(bytes, image, error);
    check(error, path);
    return image;
}

} // namespace isochron::stereo
