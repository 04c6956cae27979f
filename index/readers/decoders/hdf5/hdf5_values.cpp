// Reads boxes of values from a dataset.
#include "index/readers/decoders/hdf5/hdf5_values.h"

#include "index/error.h"
#include "index/readers/formats/data_stream.h"

#include <fmt/format.h>

#include <hdf5.h>

#include <algorithm>
#include <cmath>

namespace isochron::index {
namespace {

hid_t memory_type(StoredType type) {
    switch (type) {
    case StoredType::i8: return H5T_NATIVE_INT8;
    case StoredType::u8: return H5T_NATIVE_UINT8;
    case StoredType::i16: return H5T_NATIVE_INT16;
    case StoredType::u16: return H5T_NATIVE_UINT16;
    case StoredType::i32: return H5T_NATIVE_INT32;
    case StoredType::u32: return H5T_NATIVE_UINT32;
    case StoredType::i64: return H5T_NATIVE_INT64;
    case StoredType::u64: return H5T_NATIVE_UINT64;
    case StoredType::f32: return H5T_NATIVE_FLOAT;
    case StoredType::f64: break;
    }
    return H5T_NATIVE_DOUBLE;
}

} // namespace

Hdf5Values::Hdf5Values(const Hdf5File& file, const Hdf5Dataset& dataset,
                       std::optional<std::size_t> shared)
    : file_(file), dataset_(dataset) {
    const std::string what = fmt::format("{} cannot be read", dataset.path);
    const auto open = [&](hid_t access) {
        open_ = {}; // a dataset that is open keeps the cache that it has
        open_ = {H5Dopen2(file.id(), dataset.path.c_str(), access), H5Dclose};
        file.expect(static_cast<bool>(open_), what);
    };
    open(H5P_DEFAULT);
    space_ = {H5Dget_space(open_.id()), H5Sclose};
    const Hdf5Handle properties(H5Dget_create_plist(open_.id()), H5Pclose);
    file.expect(space_ && properties, what);
    const std::size_t rank = dataset.dimensions.size();
    if (H5Pget_layout(properties.id()) == H5D_CHUNKED) {
        std::vector<hsize_t> chunk(rank);
        file.expect(H5Pget_chunk(properties.id(), static_cast<int>(rank), chunk.data()) >= 0, what);
        chunk_.assign(chunk.begin(), chunk.end());
    }
    expect_filters(properties.id());
    expect_room_for(properties.id(), file.name());
    if (chunk_.empty())
        return;
    // Bytes of a chunk, chunks of a step.
    double bytes = static_cast<double>(size_of(*dataset.type)), chunks = 1;
    for (std::size_t i = 0; i < rank; ++i) {
        bytes *= static_cast<double>(chunk_[i]);
        if (i != shared)
            chunks *= std::ceil(static_cast<double>(dataset.dimensions[i]) /
                                static_cast<double>(chunk_[i]));
    }
    constexpr double kCache = 1 << 20; // HDF5's own
    in_parts_ = bytes > kCache && H5Pget_nfilters(properties.id()) == 0;
    // A large chunk that is the whole step is kept, too: pieces of it need less room beside it.
    constexpr double kMostBytes = 512.0 * (1 << 20), kMostChunks = 1e6, kLarge = 64 << 20;
    const bool has_steps = shared && chunk_[*shared] > 1;
    const bool is_all = chunks == 1 && bytes > kLarge && !in_parts_;
    if ((!has_steps && !is_all) || bytes * chunks > kMostBytes || chunks > kMostChunks)
        return;
    in_parts_ = is_all;
    const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    constexpr std::size_t kSlotsPerChunk = 10; // as HDF5 advises
    H5Pset_chunk_cache(access.id(), static_cast<std::size_t>(chunks) * kSlotsPerChunk + 1,
                       static_cast<std::size_t>(bytes * chunks), 1.0);
    open(access.id());
}

void Hdf5Values::expect_filters(std::int64_t properties) const {
    const int filters = H5Pget_nfilters(properties);
    for (int i = 0; i < filters; ++i) {
        unsigned flags = 0, config = 0;
        std::size_t values = 0;
        char name[64]{};
        const H5Z_filter_t id = H5Pget_filter2(properties, static_cast<unsigned>(i), &flags,
                                               &values, nullptr, sizeof name, name, &config);
        file_.expect(id >= 0, fmt::format("{}: damaged filters", dataset_.path));
        if (H5Zfilter_avail(id) <= 0)
            throw Error("{}: {} is packed by filter {}{}, which is not installed; HDF5 finds "
                        "filters by HDF5_PLUGIN_PATH",
                        file_.name(), dataset_.path, id, *name ? fmt::format(" ({})", name) : "");
    }
}

void Hdf5Values::expect_room_for(std::int64_t properties, const std::filesystem::path& path) const {
    if (H5Pget_layout(properties) == H5D_VIRTUAL || H5Pget_external_count(properties) > 0)
        return; // the values are in other files
    const Hdf5Handle type(H5Dget_type(open_.id()), H5Tclose);
    double bytes = static_cast<double>(H5Tget_size(type.id())), chunk_bytes = bytes;
    for (const std::uint64_t length : dataset_.dimensions)
        bytes *= static_cast<double>(length);
    // Values that were never written take no room; they are treated as deflated.
    Compression compression = Compression::none;
    if (H5Pget_layout(properties) == H5D_CHUNKED || H5Dget_storage_size(open_.id()) == 0) {
        compression = Compression::deflate;
        for (int i = 0; i < H5Pget_nfilters(properties); ++i) {
            std::size_t values = 0;
            const H5Z_filter_t id = H5Pget_filter2(properties, static_cast<unsigned>(i), nullptr,
                                                   &values, nullptr, 0, nullptr, nullptr);
            if (id != H5Z_FILTER_DEFLATE && id != H5Z_FILTER_SHUFFLE && id != H5Z_FILTER_FLETCHER32)
                compression = Compression::bzip2; // the ratio of other filters is unknown
        }
        for (const std::uint64_t length : chunk_)
            chunk_bytes *= static_cast<double>(length);
    }
    constexpr double kMost = 1e18; // beyond any file, within 64 bits
    expect_room(path, 0, compression,
                static_cast<std::uint64_t>(std::min(std::max(bytes, chunk_bytes), kMost)));
}

void Hdf5Values::read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
                      std::span<std::byte> out) const {
    const std::string what = fmt::format("{} cannot be read", dataset_.path);
    const std::vector<hsize_t> from(start.begin(), start.end()), size(count.begin(), count.end());
    file_.expect(H5Sselect_hyperslab(space_.id(), H5S_SELECT_SET, from.data(), nullptr, size.data(),
                                     nullptr) >= 0,
                 what);
    // The memory has the same shape as the file: HDF5 copies between other shapes value by value.
    const Hdf5Handle memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                            H5Sclose);
    file_.expect(H5Dread(open_.id(), memory_type(*dataset_.type), memory.id(), space_.id(),
                         H5P_DEFAULT, out.data()) >= 0,
                 what);
}

} // namespace isochron::index
