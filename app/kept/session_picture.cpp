// The small picture that a kept session has of what was seen last.
#include "app/kept/session_picture.h"

#include "stereo/image_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

#include <zlib.h>

namespace isochron::app {
namespace {

constexpr const char* kPictureName = "picture.png"; ///< tells the format
constexpr std::string_view kDigits64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

render::Image made_small(const render::Image& picture) {
    const int w = picture.width, h = picture.height;
    if (w <= kPictureWidth && h <= kPictureHeight)
        return picture;
    // The side that is too long by more decides: w / kPictureWidth against h / kPictureHeight.
    const bool wide = std::int64_t{w} * kPictureHeight >= std::int64_t{h} * kPictureWidth;
    const auto share = [](int side, int part, int of) {
        return static_cast<int>(std::int64_t{side} * part / of);
    };
    render::Image small{.width = wide ? kPictureWidth : std::max(1, share(w, kPictureHeight, h)),
                        .height = wide ? std::max(1, share(h, kPictureWidth, w)) : kPictureHeight,
                        .rgba = {}};
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            const int left = share(w, x, small.width), right = share(w, x + 1, small.width);
            const int top = share(h, y, small.height), bottom = share(h, y + 1, small.height);
            std::array<std::uint64_t, 4> sum{};
            for (int row = top; row < bottom; ++row)
                for (int column = left; column < right; ++column)
                    for (std::size_t i = 0; i < 4; ++i)
                        sum[i] += picture.at(column, row)[i];
            const auto count =
                static_cast<std::uint64_t>(right - left) * static_cast<std::uint64_t>(bottom - top);
            for (const std::uint64_t each : sum)
                small.rgba.push_back(static_cast<std::uint8_t>((each + count / 2) / count));
        }
    return small;
}

// https://www.w3.org/TR/png-3/
std::string png_of(const render::Image& picture) {
    const auto big_endian = [](std::uint32_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes += static_cast<char>(value >> shift & 255);
        return bytes;
    };
    const auto bytes_of = [](const auto& some) {
        return reinterpret_cast<const Bytef*>(some.data());
    };
    std::string rows;
    const std::size_t row = 4 * static_cast<std::size_t>(picture.width);
    for (std::size_t at = 0; at < picture.rgba.size(); at += row) {
        rows += '\0'; // as they are
        rows.append(reinterpret_cast<const char*>(picture.rgba.data()) + at, row);
    }
    uLongf size = compressBound(rows.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, bytes_of(rows), rows.size());
    packed.resize(size);
    std::string png = "\x89PNG\r\n\x1a\n";
    const auto add = [&](const std::string& chunk, std::size_t length) {
        const auto check = crc32(0, bytes_of(chunk), static_cast<uInt>(chunk.size()));
        png += big_endian(static_cast<std::uint32_t>(length)) + chunk +
               big_endian(static_cast<std::uint32_t>(check));
    };
    add("IHDR" + big_endian(static_cast<std::uint32_t>(picture.width)) +
            big_endian(static_cast<std::uint32_t>(picture.height)) +
            std::string("\x08\x06\0\0\0", 5), // 8 bits, with alpha
        13);
    add("IDAT" + packed, packed.size());
    add("IEND", 0);
    return png;
}

std::optional<render::Image> picture_in(const std::string& png) {
    try {
        return stereo::decoded_image(std::as_bytes(std::span(png)), kPictureName);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

std::string to_base64(std::string_view bytes) {
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::string_view some = bytes.substr(at, 3);
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i)
            bits = bits << 8 | (i < some.size() ? static_cast<std::uint8_t>(some[i]) : 0u);
        for (std::size_t i = 0; i < 4; ++i)
            text += i <= some.size() ? kDigits64[bits >> (18 - 6 * i) & 63] : '=';
    }
    return text;
}

std::optional<std::string> from_base64(std::string_view text) {
    std::string bytes;
    if (text.size() % 4 != 0)
        return std::nullopt;
    for (std::size_t at = 0; at < text.size(); at += 4) {
        std::string_view some = text.substr(at, 4);
        while (at + 4 == text.size() && some.size() > 2 && some.ends_with('='))
            some.remove_suffix(1);
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t digit = i < some.size() ? kDigits64.find(some[i]) : 0;
            if (digit == kDigits64.npos)
                return std::nullopt;
            bits = bits << 6 | static_cast<std::uint32_t>(digit);
        }
        for (std::size_t i = 0; i + 1 < some.size(); ++i)
            bytes += static_cast<char>(bits >> (16 - 8 * i) & 255);
    }
    return bytes;
}

} // namespace isochron::app
