// Reads and writes pictures through the module that handles their formats.
#include "stereo/image_file.h"

#include "index/error.h"
#include "index/readers/process/reader_pool.h"
#include "index/system/memory_limit.h"
#include "index/system/module.h"
#include "index/system/new_file.h"
#include "render/gl/gl.h"
#include "stereo/image_module/image_module.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace isochron::stereo {
namespace {

using image_module::PictureFormat;

/// Address space that the picture module takes [bytes]. With less, a library of it (log4cplus) waits
/// for good for threads that cannot start.
constexpr std::uint64_t kModuleAddresses = 512 << 20;

/// A function of the picture module. @throws index::Error naming the picture, and the package that
/// is missing where the library of pictures is
template <typename Function>
Function* picture_function(const char* name, const std::filesystem::path& picture) {
    try {
        index::file_of_program("libisochron_images.so");
    } catch (const index::Error& error) {
        throw index::Error("{}: {}", picture.string(), error.what());
    }
    static std::atomic<bool> loaded = false;
    if (!loaded && index::addresses_left() < kModuleAddresses)
        throw std::bad_alloc();
    try {
        Function* function =
            reinterpret_cast<Function*>(index::module_symbol("isochron_images", name));
        loaded = true;
        return function;
    } catch (const index::Error& error) {
        throw index::Error("{}: pictures need the package {}: {}", picture.string(),
                           ISOCHRON_PICTURE_PACKAGE, error.what());
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
        throw render::Error("{}: {}", picture.string(), error);
}

struct ReadFile {
    std::string note;
    render::Image image;
};

/// The reply, which must be of this kind. @throws render::Error with the reader's message if not
template <class Reply>
Reply expect_reply(index::ReaderReply reply, const std::filesystem::path& picture) {
    if (const auto* refused = std::get_if<index::Refused>(&reply))
        throw render::Error(refused->message);
    auto* expected = std::get_if<Reply>(&reply);
    if (!expected)
        throw render::Error("{}: its reader sent another reply than was asked for",
                            picture.string());
    return std::move(*expected);
}

/// Pictures come from elsewhere, and the libraries that decode them have had faults: a process
/// behind the fence reads them. What it says is not trusted either.
ReadFile read_in_reader(const std::filesystem::path& path, bool pixels) {
    picture_function<image_module::Encode>(image_module::kEncode, path); // or says what is missing
    constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;        // as the module has it
    ReadFile file;
    try {
        index::ReaderPool& readers = index::readers_of_this_process();
        readers.let_read(index::file_of_program("libisochron_images.so"));
        readers.let_read(path);
        auto reader = readers.take("isochron-reader-image");
        reader->ask(index::ReadPicture{path, pixels});
        auto read = expect_reply<index::PictureRead>(reader->reply(), path);
        file.note = std::move(read.note);
        if (pixels) {
            const std::uint64_t count = std::uint64_t{read.width} * read.height;
            if (count == 0 || count > kMostPixels)
                throw render::Error("{}: a picture of {} x {} pixels cannot be read", path.string(),
                                    read.width, read.height);
            const auto memory = reader->memory(4 * count);
            reader->ask(index::TakePicture{});
            expect_reply<index::SlabRead>(reader->reply(), path);
            file.image = {static_cast<int>(read.width), static_cast<int>(read.height),
                          std::vector<std::uint8_t>(4 * count)};
            std::memcpy(file.image.rgba.data(), memory.data(), 4 * count);
        }
        readers.give_back(std::move(reader));
    } catch (const index::ReaderEnded& ended) {
        throw render::Error("{}: cannot be read: {}", path.string(), ended.what());
    }
    return file;
}

} // namespace

bool is_picture_name(const std::filesystem::path& path) {
    return format_of(path).has_value();
}

std::vector<std::byte> encoded_image(const render::Image& image, const std::filesystem::path& path,
                                     const std::string& note) {
    const std::optional<PictureFormat> format = format_of(path);
    if (!format)
        throw render::Error("{}: pictures are written as .png, .exr, .tiff or .jpg, not as '{}'",
                            path.string(), path.extension().string());
    const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) *
                        static_cast<std::size_t>(std::max(image.height, 0));
    if (pixels == 0 || image.rgba.size() != 4 * pixels)
        throw render::Error("{}: a picture of {}x{} pixels with {} bytes cannot be written",
                            path.string(), image.width, image.height, image.rgba.size());
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
    index::write_file(path, bytes);
}

std::string read_note(const std::filesystem::path& path) {
    return read_in_reader(path, false).note;
}

render::Image read_image(const std::filesystem::path& path) {
    return read_in_reader(path, true).image;
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
