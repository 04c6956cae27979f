// Mutates the compressed contents of a file.
#include "tests/fuzz/packed_mutation.h"

#include "tests/index/readers/formats/packed.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace isochron::fuzz {
namespace {

constexpr std::size_t kMostInside = 1 << 16;

enum class Packing { gzip, zlib, bzip2 };

struct Stream {
    Packing packing;
    std::size_t begin;
};

/// The first stream whose start is in the bytes.
std::optional<Stream> stream_in(std::string_view bytes) {
    std::optional<Stream> found;
    for (const auto& [packing, magic] :
         {std::pair{Packing::gzip, std::string_view("\x1f\x8b\x08", 3)},
          {Packing::bzip2, "BZh"},
          {Packing::zlib, "\x78\xda"},
          {Packing::zlib, "\x78\x9c"}}) {
        const std::size_t at = bytes.find(magic);
        if (at != bytes.npos && (!found || at < found->begin))
            found = Stream{packing, at};
    }
    return found;
}

std::string unpacked(Packing packing, std::string_view bytes) {
    std::string inside(kMostInside, '\0');
    if (packing == Packing::bzip2) {
        auto size = static_cast<unsigned>(inside.size());
        const int result =
            BZ2_bzBuffToBuffDecompress(inside.data(), &size, const_cast<char*>(bytes.data()),
                                       static_cast<unsigned>(bytes.size()), 0, 0);
        inside.resize(result == BZ_OK ? size : 0);
        return inside;
    }
    z_stream stream{};
    constexpr int kZlibOrGzip = 47;
    if (inflateInit2(&stream, kZlibOrGzip) != Z_OK)
        return {};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(inside.data());
    stream.avail_out = static_cast<uInt>(inside.size());
    ::inflate(&stream, Z_FINISH);
    inside.resize(stream.total_out);
    inflateEnd(&stream);
    return inside;
}

} // namespace

std::optional<std::size_t> mutate_packed(std::span<std::uint8_t> data, std::size_t most,
                                         unsigned seed, Mutate mutate) {
    const std::string bytes(data.begin(), data.end());
    const auto stream = stream_in(bytes);
    if (!stream)
        return std::nullopt;
    std::string head = bytes.substr(0, stream->begin);
    std::string inside = unpacked(stream->packing, std::string_view(bytes).substr(stream->begin));
    if (inside.empty())
        return std::nullopt;
    // Now and then what comes before it, which then keeps a stream that passes its check.
    std::string& changed = !head.empty() && seed / 2 % 2 == 0 ? head : inside;
    const std::size_t size = changed.size();
    changed.resize(size + 1024);
    changed.resize(mutate(reinterpret_cast<std::uint8_t*>(changed.data()), size, changed.size()));
    const std::string result = head + (stream->packing == Packing::gzip   ? index::gzip(inside)
                                       : stream->packing == Packing::zlib ? index::zlib(inside)
                                                                          : index::bzip2(inside));
    if (result.size() > most)
        return std::nullopt;
    std::copy(result.begin(), result.end(), data.data());
    return result.size();
}

} // namespace isochron::fuzz
