// Decompression filters for HDF5's pipeline.
//
// Numbers: "Registered Filter Plugins", The HDF Group. LZF after its format in lzf_d.c's comment,
// M. Lehmann, LibLZF; Blosc by its library.
#include "index/readers/decoders/hdf5/hdf5_filters.h"

#ifdef ISOCHRON_WITH_BLOSC
#include <blosc.h>
#endif
#include <hdf5.h>
#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

namespace isochron::index {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// @return number of decompressed bytes; none: damaged, or more than fit `out`
std::optional<std::size_t> decompress_lzf(Bytes in, std::span<std::uint8_t> out) {
    std::size_t i = 0, o = 0;
    while (i < in.size()) {
        const unsigned control = in[i++];
        if (control < 32) { // `control` + 1 uncompressed bytes
            const std::size_t count = control + 1;
            if (count > in.size() - i || count > out.size() - o)
                return std::nullopt;
            std::memcpy(&out[o], &in[i], count);
            i += count;
            o += count;
            continue;
        }
        std::size_t count = control >> 5;
        if (count == 7 && i < in.size())
            count += in[i++];
        if (i >= in.size())
            return std::nullopt;
        const std::size_t back = ((control & 31u) << 8) + in[i++] + 1;
        count += 2;
        if (back > o || count > out.size() - o)
            return std::nullopt;
        for (; count > 0; --count, ++o) // source and destination may overlap
            out[o] = out[o - back];
    }
    return o;
}

std::optional<std::size_t> decompress_zstd(Bytes in, std::span<std::uint8_t> out) {
    const std::size_t count = ZSTD_decompress(out.data(), out.size(), in.data(), in.size());
    return ZSTD_isError(count) ? std::nullopt : std::optional(count);
}

using Decompress = std::optional<std::size_t> (*)(Bytes in, std::span<std::uint8_t> out);

/// Runs a decompressor on memory that HDF5 allocates and frees. @return 0: failed
std::size_t decompress(Decompress with, std::size_t size, std::size_t bytes, std::size_t* buffer,
                       void** data) {
    if (size == 0)
        return 0;
    void* out = H5allocate_memory(size, false);
    if (!out)
        return 0;
    const auto count = with(Bytes(static_cast<const std::uint8_t*>(*data), bytes),
                            {static_cast<std::uint8_t*>(out), size});
    if (!count || *count == 0) {
        H5free_memory(out);
        return 0;
    }
    H5free_memory(*data);
    *data = out;
    *buffer = size;
    return *count;
}

std::size_t lzf_filter(unsigned flags, std::size_t count, const unsigned* values, std::size_t bytes,
                       std::size_t* buffer, void** data) {
    constexpr std::size_t kChunkBytes = 2; // index in the filter's values
    if ((flags & H5Z_FLAG_REVERSE) == 0 || count <= kChunkBytes)
        return 0;
    return decompress(decompress_lzf, values[kChunkBytes], bytes, buffer, data);
}

std::size_t zstd_filter(unsigned flags, std::size_t, const unsigned*, std::size_t bytes,
                        std::size_t* buffer, void** data) {
    const unsigned long long size = ZSTD_getFrameContentSize(*data, bytes);
    if ((flags & H5Z_FLAG_REVERSE) == 0 || size == ZSTD_CONTENTSIZE_UNKNOWN ||
        size == ZSTD_CONTENTSIZE_ERROR)
        return 0;
    return decompress(decompress_zstd, size, bytes, buffer, data);
}

#ifdef ISOCHRON_WITH_BLOSC
std::optional<std::size_t> decompress_blosc(Bytes in, std::span<std::uint8_t> out) {
    const int count = blosc_decompress_ctx(in.data(), out.data(), out.size(), 1);
    return count < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(count));
}

std::size_t blosc_filter(unsigned flags, std::size_t, const unsigned*, std::size_t bytes,
                         std::size_t* buffer, void** data) {
    std::size_t size = 0;
    if ((flags & H5Z_FLAG_REVERSE) == 0 || blosc_cbuffer_validate(*data, bytes, &size) < 0)
        return 0;
    return decompress(decompress_blosc, size, bytes, buffer, data);
}
#endif

void register_filter(H5Z_filter_t id, const char* name, H5Z_func_t filter) {
    if (H5Zfilter_avail(id) > 0)
        return; // a plugin provides it
    H5Z_class2_t description{};
    description.version = H5Z_CLASS_T_VERS;
    description.id = id;
    description.decoder_present = 1;
    description.name = name;
    description.filter = filter;
    H5Zregister(&description);
}

} // namespace

void register_hdf5_filters() {
    register_filter(32000, "lzf", lzf_filter);
    register_filter(32015, "zstd", zstd_filter);
#ifdef ISOCHRON_WITH_BLOSC
    register_filter(32001, "blosc", blosc_filter);
#endif
}

} // namespace isochron::index
