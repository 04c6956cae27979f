// Decodes pixels, whole files or frame by frame.
#include "index/readers/decoders/dicom/dicom_pixels.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <gdcmImageReader.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace isochron::index {
namespace {

/// The size of a picture as it is stored: a frame, or a mosaic of all.
std::uint32_t stored_columns(const DicomFile& file) {
    return file.columns * file.tiles_across;
}
std::uint32_t stored_rows(const DicomFile& file) {
    return file.rows * file.tiles_down;
}
std::uint32_t stored_frames(const DicomFile& file) {
    return file.tiles_across > 1 ? 1 : file.frames;
}

std::size_t frame_bytes(const DicomFile& file) {
    return std::size_t{stored_columns(file)} * stored_rows(file) * file.samples *
           size_of(file.type);
}

/// Leaves only the value of each stored number, with its sign: other bits may stand around it.
template <class T>
void keep_value(T* values, std::size_t count, const DicomFile& file) {
    constexpr unsigned kBits = 8 * sizeof(T);
    if (file.bits == kBits)
        return;
    using Unsigned = std::make_unsigned_t<T>;
    const unsigned above = kBits - file.bits - file.lowest_bit, all = kBits - file.bits;
    for (std::size_t i = 0; i < count; ++i) {
        const auto high = static_cast<Unsigned>(static_cast<Unsigned>(values[i]) << above);
        values[i] = static_cast<T>(static_cast<T>(high) >> all); // an arithmetic shift, with sign
    }
}

} // namespace

void DicomPixels::decode(const std::filesystem::path& path, const DicomFile& file,
                         std::uint32_t frame) {
    const std::string name = path.string();
    const bool alone = by_frame(file);
    if (decoded_ == path && (!alone || frame_ == frame))
        return;
    decoded_.clear();
    const std::size_t expected = frame_bytes(file) * (alone ? 1 : stored_frames(file));
    const auto check = [&](const gdcm::Image& image) {
        const unsigned* sizes = image.GetDimensions();
        if (sizes[0] != stored_columns(file) || sizes[1] != stored_rows(file) ||
            image.GetPixelFormat().GetSamplesPerPixel() != file.samples ||
            image.GetPixelFormat().GetBitsAllocated() != 8 * size_of(file.type))
            throw Error("{}: its pixels are {} x {}, its header says {} x {}", name, sizes[0],
                        sizes[1], stored_columns(file), stored_rows(file));
    };
    if (alone) {
        pixels_.resize(expected);
        const std::size_t got = InputFile(path).read(file.pixels_at + frame * expected,
                                                     std::as_writable_bytes(std::span(pixels_)));
        if (got < expected)
            throw Error("{}: truncated: frame {} has {} bytes, expected {}", name, frame, got,
                        expected);
        planar_ = file.planar;
        if (file.big_endian)
            swap_bytes(std::as_writable_bytes(std::span(pixels_)), size_of(file.type));
    } else {
        gdcm::ImageReader reader;
        reader.SetFileName(path.c_str());
        if (!reader.Read())
            throw Error("{}: its pixels cannot be decoded: truncated, or damaged", name);
        const gdcm::Image& image = reader.GetImage();
        check(image);
        if (image.GetBufferLength() != expected)
            throw Error("{}: its pixels have {} bytes, expected {}", name, image.GetBufferLength(),
                        expected);
        pixels_.resize(expected);
        if (!image.GetBuffer(pixels_.data()))
            throw Error("{}: its pixels cannot be decoded", name);
        planar_ = image.GetPlanarConfiguration() == 1;
    }
    decoded_ = path;
    frame_ = alone ? frame : 0;
}

void DicomPixels::read(const std::filesystem::path& path, const DicomFile& file,
                       std::uint32_t frame, std::size_t sample, std::span<std::byte> out) {
    const bool tiled = file.tiles_across > 1;
    const std::uint32_t stored = tiled ? 0 : frame;
    decode(path, file, stored);
    const std::size_t size = size_of(file.type), wide = stored_columns(file);
    const bool apart = planar_ || file.samples == 1;
    const std::size_t next = apart ? size : file.samples * size; // from a pixel to the next
    const char* from = pixels_.data() + (stored - frame_) * frame_bytes(file) +
                       sample * (apart ? wide * stored_rows(file) * size : size);
    if (tiled)
        from += (frame / file.tiles_across * wide * file.rows +
                 frame % file.tiles_across * file.columns) *
                next;
    std::byte* to = out.data();
    for (std::uint32_t row = 0; row < file.rows; ++row, from += wide * next)
        for (std::uint32_t column = 0; column < file.columns; ++column, to += size)
            std::memcpy(to, from + column * next, size);
    const std::size_t count = std::size_t{file.columns} * file.rows;
    visit_stored_type(file.type, [&]<class T>(std::type_identity<T>) {
        if constexpr (std::is_integral_v<T>)
            keep_value(reinterpret_cast<T*>(out.data()), count, file);
    });
}

} // namespace isochron::index
