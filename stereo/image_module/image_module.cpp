// Encoding and decoding of pictures with OpenImageIO, the one place that knows it.
#include "stereo/image_module/image_module.h"

#include "render/gl/srgb.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <cmath>
#include <exception>

namespace isochron::stereo::image_module {
namespace {

using render::linear_from_srgb;
using render::srgb_from_linear;

/// Error texts of OpenImageIO can run over several lines.
std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    for (char& c : text)
        if (c == '\n')
            c = ' ';
    return text.empty() ? "unknown error of OpenImageIO" : text;
}

/// The name of the note among the file's attributes.
constexpr const char* kNote = "isochron";

void encode(const render::Image& image, const std::string& format, const std::string& note,
            std::vector<std::byte>& bytes, std::string& error) {
    auto output = OIIO::ImageOutput::create(format);
    if (!output) {
        error = one_line(OIIO::geterror());
        return;
    }
    const bool linear = format == "exr";
    OIIO::ImageSpec spec(image.width, image.height, 3,
                         linear ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
    spec.attribute("DateTime",
                   ""); // else EXR gets the time of day: no two replays would be the same
    if (!note.empty())
        spec.attribute(kNote, note);
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput memory(file);
    output->set_ioproxy(&memory);
    // The name only tells the format; the bytes go to memory.
    if (!output->open("picture." + format, spec)) {
        error = one_line(output->geterror());
        return;
    }
    const auto pixels = static_cast<std::size_t>(image.width) * image.height;
    bool written = false;
    if (linear) {
        std::array<float, 256> table;
        for (int i = 0; i < 256; ++i)
            table[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
        std::vector<float> rgb(3 * pixels);
        for (std::size_t i = 0; i < rgb.size(); ++i)
            rgb[i] = table[image.rgba[i / 3 * 4 + i % 3]];
        written = output->write_image(OIIO::TypeDesc::FLOAT, rgb.data());
    } else {
        written = output->write_image(OIIO::TypeDesc::UINT8, image.rgba.data(), 4);
    }
    if (!written || !output->close()) {
        error = one_line(output->geterror());
        return;
    }
    const auto* begin = reinterpret_cast<const std::byte*>(file.data());
    bytes.assign(begin, begin + file.size());
}

void decode(const std::string& path, render::Image& image, std::string& error) {
    auto input = OIIO::ImageInput::open(path);
    if (!input) {
        error = one_line(OIIO::geterror());
        return;
    }
    const OIIO::ImageSpec& spec = input->spec();
    const int channels = spec.nchannels;
    if (channels != 1 && channels != 3 && channels != 4) {
        error = "a picture has 1, 3 or 4 channels, got " + std::to_string(channels);
        return;
    }
    const auto pixels = static_cast<std::size_t>(spec.width) * spec.height;
    std::vector<float> values(pixels * channels);
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data())) {
        error = one_line(input->geterror());
        return;
    }
    const bool linear = std::string(input->format_name()) == "openexr";
    const auto byte = [](float v) {
        return static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(v, 0.0f), 1.0f) * 255.0f));
    };
    image = {spec.width, spec.height, std::vector<std::uint8_t>(4 * pixels, 255)};
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* pixel = values.data() + i * channels;
        for (int c = 0; c < 3; ++c) {
            const float v = pixel[channels == 1 ? 0 : c];
            image.rgba[4 * i + c] = byte(linear ? srgb_from_linear(v) : v);
        }
        if (channels == 4)
            image.rgba[4 * i + 3] = byte(pixel[3]);
    }
}

void read_note(const std::string& path, std::string& note, std::string& error) {
    auto input = OIIO::ImageInput::open(path);
    if (input)
        note = std::string(input->spec().get_string_attribute(kNote));
    else
        error = one_line(OIIO::geterror());
}

/// Nothing may be thrown across the border of a module.
template <typename Function>
void guarded(std::string& error, Function function) {
    try {
        function();
    } catch (const std::exception& caught) {
        error = one_line(caught.what());
    }
}

} // namespace

extern "C" __attribute__((visibility("default"))) void
isochron_encode_image(const render::Image& image, const std::string& format,
                      const std::string& note, std::vector<std::byte>& bytes, std::string& error) {
    guarded(error, [&] { encode(image, format, note, bytes, error); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_read_note(const std::string& path, std::string& note, std::string& error) {
    guarded(error, [&] { read_note(path, note, error); });
}

extern "C" __attribute__((visibility("default"))) void
isochron_decode_image(const std::string& path, render::Image& image, std::string& error) {
    guarded(error, [&] { decode(path, image, error); });
}

} // namespace isochron::stereo::image_module
