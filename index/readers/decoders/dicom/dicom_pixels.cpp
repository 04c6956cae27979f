// Decodes pixels, whole files or frame by frame.
#include "index/readers/decoders/dicom/dicom_pixels.h"

#include "index/error.h"
#include "index/system/input_file.h"

#include <fmt/format.h>
#include <gdcmImageReader.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>

namespace isochron::index {
namespace {

std::size_t frame_bytes(const DicomFile& file) {
    return std::size_t{file.columns} * file.rows * file.samples * size_of(file.type);
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
    const std::size_t expected = frame_bytes(file) * (alone ? 1 : file.frames);
    const auto check = [&](const gdcm::Image& image) {
        const unsigned* sizes = image.GetDimensions();
        if (sizes[0] != file.columns || sizes[1] != file.rows ||
            image.GetPixelFormat().GetSamplesPerPixel() != file.samples ||
            image.GetPixelFormat().GetBitsAllocated() != 8 * size_of(file.type))
            throw Error(fmt::format("{}: its pixels are {} x {}, its header says {} x {}", name,
                                    sizes[0], sizes[1], file.columns, file.rows));
    };
    if (alone) {
        pixels_.resize(expected);
        const std::size_t got = InputFile(path).read(file.pixels_at + frame * expected,
                                                     std::as_writable_bytes(std::span(pixels_)));
        if (got < expected)
            throw Error(fmt::format("{}: truncated: frame {} has {} bytes, expected {}", name,
                                    frame, got, expected));
        planar_ = file.planar;
        const auto size = static_cast<std::ptrdiff_t>(size_of(file.type));
        if (file.big_endian)
            for (auto value = pixels_.begin(); value != pixels_.end(); value += size)
                std::reverse(value, value + size);
    } else {
        gdcm::ImageReader reader;
        reader.SetFileName(path.c_str());
        if (!reader.Read())
            throw Error(
                fmt::format("{}: its pixels cannot be decoded: truncated, or damaged", name));
        const gdcm::Image& image = reader.GetImage();
        check(image);
        if (image.GetBufferLength() != expected)
            throw Error(fmt::format("{}: its pixels have {} bytes, expected {}", name,
                                    image.GetBufferLength(), expected));
        pixels_.resize(expected);
        if (!image.GetBuffer(pixels_.data()))
            throw Error(fmt::format("{}: its pixels cannot be decoded", name));
        planar_ = image.GetPlanarConfiguration() == 1;
    }
    decoded_ = path;
    frame_ = alone ? frame : 0;
}

void DicomPixels::read(const std::filesystem::path& path, const DicomFile& file,
                       std::uint32_t frame, std::size_t sample, std::span<std::byte> out) {
    decode(path, file, frame);
    const std::size_t count = std::size_t{file.columns} * file.rows, size = size_of(file.type);
    const char* from = pixels_.data() + (frame - frame_) * frame_bytes(file);
    if (planar_ || file.samples == 1)
        std::memcpy(out.data(), from + sample * count * size, count * size);
    else
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(out.data() + i * size, from + (i * file.samples + sample) * size, size);
    visit_stored_type(file.type, [&]<class T>(std::type_identity<T>) {
        if constexpr (std::is_integral_v<T>)
            keep_value(reinterpret_cast<T*>(out.data()), count, file);
    });
}

} // namespace isochron::index
