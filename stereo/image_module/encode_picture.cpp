// Writes pictures: PNG, TIFF and JPEG with display values, EXR in linear light as half floats. The
// same picture with the same note always gives the same bytes.
#include "stereo/image_module/picture_codec.h"

#include "render/gl/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

namespace isochron::stereo::image_module {
namespace {

/// A picture in JPEG is at most this wide and high. libjpeg ends the program where it is larger.
constexpr int kJpegSide = 65500;
/// JPEG counts the bytes of a comment in 16 bits, and OpenImageIO reads no more of a comment in a
/// TIFF. libjpeg ends the program if a comment is longer. The text around the note needs the rest.
constexpr std::size_t kMostNote = 64'000;

/// Threads of OpenImageIO. With several threads it compresses the strips of a TIFF itself, with one
/// it leaves them to libtiff, which gives other bytes: so every machine has several.
constexpr int kThreads = 4;

[[noreturn]] void fail(OIIO::ImageOutput& output) {
    std::string reason = output.geterror();
    throw std::runtime_error(reason.empty() ? "the picture cannot be written" : reason);
}

void check_limits(const render::Image& image, PictureFormat format, const std::string& note) {
    if (format == PictureFormat::jpeg && std::max(image.width, image.height) > kJpegSide)
        throw std::runtime_error("a picture of " + std::to_string(image.width) + " x " +
                                 std::to_string(image.height) +
                                 " pixels does not fit into a JPEG file (65500 x 65500 at most)");
    const bool any = format == PictureFormat::png || format == PictureFormat::exr;
    if (!any && note.size() > kMostNote)
        throw std::runtime_error("the note of " + std::to_string(note.size()) +
                                 " bytes does not fit into a " + library_name_of(format) +
                                 " file (64000 at most): .png and .exr hold longer ones");
}

/// Whether a file says how opaque pixels are. The others show what is drawn over nothing as over white.
bool has_opacity(const render::Image& image, PictureFormat format) {
    return !image.opaque && (format == PictureFormat::png || format == PictureFormat::tiff);
}

OIIO::ImageSpec spec_of(const render::Image& image, PictureFormat format, const std::string& note) {
    const bool linear = format == PictureFormat::exr;
    OIIO::ImageSpec spec(image.width, image.height, has_opacity(image, format) ? 4 : 3,
                         linear ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    // Without an attribute of this name, the time of writing is stored. A number is no time.
    spec.attribute("DateTime", 0);
    if (format == PictureFormat::png || format == PictureFormat::jpeg)
        spec.attribute("oiio:ColorSpace", "sRGB"); // as TIFF is without saying so
    if (format == PictureFormat::png) {
        // Filter "sub" (each pixel minus the pixel before it) and level 3: a third of the time that
        // the usual choices take (the best filter of each row, level 6), and a tenth more bytes.
        spec.attribute("png:filter", 16);
        spec.attribute("png:compressionLevel", 3);
    }
    if (format == PictureFormat::exr)
        spec.attribute("compression", "zip:4");
    if (format == PictureFormat::jpeg) {
        spec.attribute("compression", "jpeg:95");
        spec.attribute("jpeg:subsampling", "4:4:4"); // thin colored lines stay as they are
    }
    if (has_opacity(image, format))
        spec.attribute("oiio:UnassociatedAlpha", 1);
    if (image.dpi > 0) {
        spec.attribute("XResolution", static_cast<float>(image.dpi));
        spec.attribute("YResolution", static_cast<float>(image.dpi));
        spec.attribute("ResolutionUnit", "in");
    }
    if (!note.empty())
        spec.attribute(note_attribute_of(format), note);
    return spec;
}

std::vector<half> linear_rgb(const render::Image& image) {
    std::array<half, 256> linear;
    for (int i = 0; i < 256; ++i)
        linear[i] = render::linear_from_srgb(static_cast<float>(i) / 255.0f);
    std::vector<half> rgb(image.rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = linear[image.rgba[i / 3 * 4 + i % 3]];
    return rgb;
}

render::Image over_white(render::Image image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        if (image.rgba[i + 3] == 255)
            continue;
        const float opacity = static_cast<float>(image.rgba[i + 3]) / 255.0f;
        for (std::size_t channel = i; channel < i + 3; ++channel) {
            const float light =
                render::linear_from_srgb(static_cast<float>(image.rgba[channel]) / 255.0f);
            image.rgba[channel] = static_cast<std::uint8_t>(
                std::lround(255.0f * render::srgb_from_linear(opacity * light + 1.0f - opacity)));
        }
    }
    return image;
}

void write_pixels(OIIO::ImageOutput& output, const render::Image& image, PictureFormat format) {
    bool written = false;
    if (format == PictureFormat::exr) {
        written = output.write_image(OIIO::TypeDesc::HALF, linear_rgb(image).data());
    } else {
        // All rows in one call: between two calls OpenImageIO looks at the clock and, once seconds
        // have passed, stores the unfinished TIFF, which changes its bytes.
        const OIIO::stride_t pixel = 4, row = pixel * image.width; // passes over alpha
        written = output.write_scanlines(0, image.height, 0, OIIO::TypeDesc::UINT8,
                                         image.rgba.data(), pixel, row);
    }
    if (!written || !output.close())
        fail(output);
}

} // namespace

void set_up_library() {
    [[maybe_unused]] static const bool once =
        OIIO::attribute("threads", kThreads) &&
        OIIO::attribute("exr_threads", -1) && // in the caller's thread
        OIIO::attribute("debug", 0);          // Debian's prints otherwise
}

const char* library_name_of(PictureFormat format) {
    constexpr std::array kNames{"png", "openexr", "tiff", "jpeg"};
    return kNames.at(static_cast<std::size_t>(format));
}

const char* note_attribute_of(PictureFormat format) {
    constexpr std::array kNames{"isochron", "isochron", "ImageDescription", "ImageDescription"};
    return kNames.at(static_cast<std::size_t>(format));
}

std::vector<std::byte> encode(const render::Image& given, PictureFormat format,
                              const std::string& note) {
    std::optional<render::Image> flat;
    if (!given.opaque && !has_opacity(given, format))
        flat = over_white(given);
    const render::Image& image = flat ? *flat : given;
    check_limits(image, format, note);
    set_up_library();
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(library_name_of(format));
    if (!output)
        throw std::runtime_error(OIIO::geterror());
    std::vector<unsigned char> written;
    OIIO::Filesystem::IOVecOutput memory(written);
    OIIO::Filesystem::IOProxy* proxy = &memory;
    OIIO::ImageSpec spec = spec_of(image, format, note);
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (!output->open("picture", spec))
        fail(*output);
    write_pixels(*output, image, format);
    std::vector<std::byte> bytes(written.size());
    std::memcpy(bytes.data(), written.data(), written.size());
    return bytes;
}

} // namespace isochron::stereo::image_module
