// PNG by libpng: 8 bits a channel, sRGB.
#include "stereo/image_module/picture_codec.h"

#include <png.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace isochron::stereo::image_module {
namespace {

[[noreturn]] void fail(png_structp, png_const_charp what) {
    throw std::runtime_error(what);
}

void ignore(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, std::size_t size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

struct Writer {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
    png_infop info = png_create_info_struct(png);
    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

/// An open file, whose header has been read.
struct Reader {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{nullptr, std::fclose};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
    png_infop info = png_create_info_struct(png);

    explicit Reader(const std::string& path) {
        try {
            file.reset(std::fopen(path.c_str(), "rb"));
            if (!file)
                throw std::runtime_error(std::strerror(errno));
            png_init_io(png, file.get());
            png_read_info(png, info);
        } catch (...) {
            png_destroy_read_struct(&png, &info, nullptr);
            throw;
        }
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

} // namespace

std::vector<std::byte> encode_png(const render::Image& image, const std::string& note) {
    std::vector<std::byte> bytes;
    Writer writer;
    png_set_write_fn(writer.png, &bytes, append, [](png_structp) {});
    png_set_IHDR(writer.png, writer.info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_ABSOLUTE);
    if (!note.empty()) {
        std::string key = kNote,
                    value = note; // copies, as libpng takes pointers that are not const
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = key.data();
        text.text = value.data();
        text.text_length = value.size();
        png_set_text(writer.png, writer.info, &text, 1);
    }
    png_write_info(writer.png, writer.info);
    png_set_filler(writer.png, 0, PNG_FILLER_AFTER); // skips alpha
    for (int y = 0; y < image.height; ++y)
        png_write_row(writer.png, image.rgba.data() + std::size_t(4) * image.width * y);
    png_write_end(writer.png, nullptr);
    return bytes;
}

render::Image decode_png(const std::string& path) {
    Reader reader(path);
    const std::size_t width = png_get_image_width(reader.png, reader.info);
    const std::size_t height = png_get_image_height(reader.png, reader.info);
    if (width * height > kMostPixels)
        throw std::runtime_error("a picture of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " pixels is too large");
    png_set_expand(reader.png); // palettes, few bits, transparent colors
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_filler(reader.png, 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    render::Image image{int(width), int(height), std::vector<std::uint8_t>(4 * width * height)};
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y)
        rows[y] = image.rgba.data() + 4 * width * y;
    png_read_image(reader.png, rows.data());
    png_read_end(reader.png, nullptr); // checks the end of the file
    return image;
}

std::string png_note(const std::string& path) {
    Reader reader(path);
    png_textp texts = nullptr;
    const int count = png_get_text(reader.png, reader.info, &texts, nullptr);
    for (int i = 0; i < count; ++i)
        if (std::strcmp(texts[i].key, kNote) == 0)
            return {texts[i].text, texts[i].text_length};
    return {};
}

} // namespace isochron::stereo::image_module
