// The module that encodes and decodes pictures: loaded when the first picture is written or read.
#include "stereo/image_module/image_module.h"

#include "stereo/image_module/picture_codec.h"

#include <algorithm>
#include <array>
#include <exception>
#include <fstream>

namespace isochron::stereo::image_module {
namespace {

/// Turns exceptions into `error`: none may leave the module.
template <typename Function>
void guarded(std::string& error, Function function) {
    try {
        function();
    } catch (const std::exception& caught) {
        error = caught.what();
        std::ranges::replace(error, '\n', ' ');
        if (error.empty())
            error = "the picture cannot be read or written";
    }
}

/// Whether a file is EXR, by its first bytes. Files of neither format go to libpng, which reports
/// them.
bool is_exr(const std::string& path) {
    constexpr std::array<char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
    std::array<char, 4> begin{};
    std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
    return begin == kMagic;
}

} // namespace

extern "C" __attribute__((visibility("default"))) void
isochron_encode_image(const render::Image& image, const std::string& format,
                      const std::string& note, std::vector<std::byte>& bytes, std::string& error) {
    guarded(error,
            [&] { bytes = format == "exr" ? encode_exr(image, note) : encode_png(image, note); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_read_note(const std::string& path, std::string& note, std::string& error) {
    guarded(error, [&] { note = is_exr(path) ? exr_note(path) : png_note(path); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_decode_image(const std::string& path, render::Image& image, std::string& error) {
    guarded(error, [&] { image = is_exr(path) ? decode_exr(path) : decode_png(path); });
}

} // namespace isochron::stereo::image_module
