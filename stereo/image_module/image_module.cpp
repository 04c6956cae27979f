// The module that encodes and decodes pictures: loaded when the first picture is written or read.
#include "stereo/image_module/image_module.h"

#include "stereo/image_module/picture_codec.h"

#include <algorithm>
#include <exception>

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

} // namespace

extern "C" __attribute__((visibility("default"))) void
isochron_encode_image(const render::Image& image, PictureFormat format, const std::string& note,
                      std::vector<std::byte>& bytes, std::string& error) {
    guarded(error, [&] { bytes = encode(image, format, note); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_read_note(const std::string& path, std::string& note, std::string& error) {
    guarded(error, [&] { note = note_of(path); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_read_image(const std::string& path, render::Image& image, std::string& error) {
    guarded(error, [&] { image = read(path); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_decode_image(std::span<const std::byte> bytes, render::Image& image, std::string& error) {
    guarded(error, [&] { image = decode(bytes); });
}

} // namespace isochron::stereo::image_module
