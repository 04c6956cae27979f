// Decompression of chunks.
#include "index/readers/decoders/zarr/zarr_codecs.h"

#include "index/error.h"

#include <bzlib.h>
#ifdef ISOCHRON_WITH_BLOSC
#include <blosc.h>
#endif
#include <lz4.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace isochron::index {
namespace {

[[noreturn]] void fail_at(const std::string& chunk, const ZarrCodec& codec) {
    throw Error("{}: damaged: {} cannot decode it", chunk, codec.name);
}

/// CRC-32C, Castagnoli's polynomial, as RFC 3720 has it.
std::uint32_t crc32c(std::span<const std::byte> bytes) {
    static const auto table = [] {
        std::array<std::uint32_t, 256> entries{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit)
                value = value & 1 ? value >> 1 ^ 0x82f63b78u : value >> 1;
            entries[i] = value;
        }
        return entries;
    }();
    std::uint32_t sum = ~0u;
    for (const std::byte byte : bytes)
        sum = table[(sum ^ std::to_integer<std::uint32_t>(byte)) & 0xff] ^ sum >> 8;
    return ~sum;
}

void inflate_chunk(const ZarrBytes& stored, std::size_t bytes, ZarrBytes& out) {
    out.resize(bytes + 1); // one more would show that there are more
    z_stream stream{};
    constexpr int kZlibOrGzip = 32 + MAX_WBITS;
    if (::inflateInit2(&stream, kZlibOrGzip) != Z_OK)
        return out.clear();
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(stored.data()));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(stored.size(), 0xffff'ffffu));
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(std::min<std::size_t>(out.size(), 0xffff'ffffu));
    const int status = ::inflate(&stream, Z_FINISH);
    out.resize(status == Z_STREAM_END ? stream.total_out : 0);
    ::inflateEnd(&stream);
}

void unpack_zstd(const ZarrBytes& stored, std::size_t bytes, ZarrBytes& out) {
    out.resize(bytes);
    const std::size_t count = ZSTD_decompress(out.data(), out.size(), stored.data(), stored.size());
    out.resize(ZSTD_isError(count) ? 0 : count);
}

/// numcodecs writes the size before a block, in 4 bytes.
void unpack_lz4(const ZarrBytes& stored, std::size_t bytes, ZarrBytes& out) {
    if (stored.size() < 4)
        return out.clear();
    out.resize(bytes);
    const int count = LZ4_decompress_safe(
        reinterpret_cast<const char*>(stored.data() + 4), reinterpret_cast<char*>(out.data()),
        static_cast<int>(std::min<std::size_t>(stored.size() - 4, 0x7fff'ffff)),
        static_cast<int>(std::min<std::size_t>(bytes, 0x7fff'ffff)));
    out.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
}

void unpack_bzip2(const ZarrBytes& stored, std::size_t bytes, ZarrBytes& out) {
    out.resize(bytes);
    auto count = static_cast<unsigned>(std::min<std::size_t>(bytes, 0xffff'ffffu));
    const int status = BZ2_bzBuffToBuffDecompress(
        reinterpret_cast<char*>(out.data()), &count,
        reinterpret_cast<char*>(const_cast<std::byte*>(stored.data())),
        static_cast<unsigned>(std::min<std::size_t>(stored.size(), 0xffff'ffffu)), 0, 0);
    out.resize(status == BZ_OK ? count : 0);
}

#ifdef ISOCHRON_WITH_BLOSC
void unpack_blosc(const ZarrBytes& stored, std::size_t bytes, ZarrBytes& out) {
    std::size_t size = 0;
    if (blosc_cbuffer_validate(stored.data(), stored.size(), &size) < 0 || size > bytes)
        return out.clear();
    out.resize(size);
    const int count = blosc_decompress_ctx(stored.data(), out.data(), out.size(), 1);
    out.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
}
#endif

/// First bytes of all elements, then all second bytes, ...: put together again.
void unshuffle(const ZarrBytes& stored, std::size_t element, ZarrBytes& out) {
    out = stored; // what is left over stays as it is
    const std::size_t count = stored.size() / element;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t b = 0; b < element; ++b)
            out[i * element + b] = stored[b * count + i];
}

} // namespace

ZarrCodec codec_of(const std::string& name, std::size_t element, const std::string& array) {
    for (const char* known : {"gzip", "zlib", "zstd", "lz4", "bz2", "shuffle", "crc32c",
#ifdef ISOCHRON_WITH_BLOSC
                              "blosc",
#endif
                              "numcodecs.zlib"})
        if (name == known)
            return {name, element};
    throw Error("{}: packed by {}, expected blosc, zstd, gzip, zlib, lz4, bz2, shuffle or crc32c",
                array, name);
}

void decode(const ZarrCodec& codec, std::size_t most, const std::string& chunk, ZarrBytes& bytes,
            ZarrBytes& spare) {
    if (codec.name == "crc32c") {
        if (bytes.size() < 4)
            fail_at(chunk, codec);
        std::uint32_t check = 0;
        std::memcpy(&check, bytes.data() + bytes.size() - 4, 4);
        bytes.resize(bytes.size() - 4);
        if (crc32c(bytes) != check)
            fail_at(chunk, codec);
        return;
    }
    if (codec.name == "shuffle") {
        unshuffle(bytes, std::max<std::size_t>(codec.element, 1), spare);
        return bytes.swap(spare);
    }
    if (codec.name == "zstd")
        unpack_zstd(bytes, most, spare);
    else if (codec.name == "lz4")
        unpack_lz4(bytes, most, spare);
    else if (codec.name == "bz2")
        unpack_bzip2(bytes, most, spare);
#ifdef ISOCHRON_WITH_BLOSC
    else if (codec.name == "blosc")
        unpack_blosc(bytes, most, spare);
#endif
    else
        inflate_chunk(bytes, most, spare);
    if (spare.empty() || spare.size() > most)
        fail_at(chunk, codec);
    bytes.swap(spare);
}

} // namespace isochron::index
