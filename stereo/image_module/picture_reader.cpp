// `isochron-reader-image`: pictures, which OpenImageIO and the libraries behind it decode.
#include "index/error.h"
#include "index/readers/decoders/reader_program.h"
#include "index/system/module.h"
#include "stereo/image_module/image_module.h"

#include <string>
#include <utility>

namespace isochron::stereo::image_module {
namespace {

/// Loaded behind the fence: some of the libraries start threads as they are loaded, which the fence
/// must hold, too.
struct Functions {
    ReadNote* note = nullptr;
    Read* pixels = nullptr;
    std::string missing; ///< why there are none
};

Functions loaded() {
    Functions functions;
    try {
        functions.note =
            reinterpret_cast<ReadNote*>(index::module_symbol("isochron_images", kReadNote));
        functions.pixels = reinterpret_cast<Read*>(index::module_symbol("isochron_images", kRead));
    } catch (const index::Error& error) {
        functions.missing = error.what();
    }
    return functions;
}

index::DecodedPicture read_picture(const std::filesystem::path& path, bool pixels) {
    static const Functions functions = loaded();
    std::string error = functions.missing;
    index::DecodedPicture picture;
    render::Image image;
    if (error.empty() && pixels)
        functions.pixels(path.string(), image, error);
    else if (error.empty())
        functions.note(path.string(), picture.note, error);
    if (!error.empty())
        throw index::Error("{}: {}", path.string(), error);
    picture.width = static_cast<std::uint32_t>(image.width);
    picture.height = static_cast<std::uint32_t>(image.height);
    picture.rgba = std::move(image.rgba);
    return picture;
}

} // namespace
} // namespace isochron::stereo::image_module

int main() {
    return isochron::index::run_reader({}, {.picture = isochron::stereo::image_module::read_picture});
}
