// Compressed bytes and numbers as text, for tests of readers.
#pragma once

#include <bzlib.h>
#include <fmt/format.h>
#include <zlib.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace isochron::index {

/// @param window_bits of zlib: 15 for its own format, 31 for gzip
inline std::string deflated(const std::string& bytes, int window_bits) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, window_bits, 9, Z_DEFAULT_STRATEGY) !=
        Z_OK)
        throw std::runtime_error("zlib");
    std::string packed(deflateBound(&stream, bytes.size()) + 32, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    const int result = ::deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END)
        throw std::runtime_error("zlib");
    return packed;
}

inline std::string gzip(const std::string& bytes) {
    return deflated(bytes, 31);
}
inline std::string zlib(const std::string& bytes) {
    return deflated(bytes, 15);
}

inline std::string bzip2(std::string bytes) {
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 50 + 1000);
    std::string packed(size, '\0');
    if (BZ2_bzBuffToBuffCompress(packed.data(), &size, bytes.data(),
                                 static_cast<unsigned>(bytes.size()), 9, 0, 0) != BZ_OK)
        throw std::runtime_error("bzip2");
    packed.resize(size);
    return packed;
}

inline std::string as_words(const std::vector<float>& values) {
    std::string text;
    for (const float value : values)
        text += fmt::format("{}{}", text.empty() ? "" : " ", value);
    return text;
}

} // namespace isochron::index
