// Reads a NetCDF file through its library.
#include "index/readers/decoders/netcdf/netcdf_file.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/netcdf/netcdf_classic.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_filter.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostAttribute = 1 << 20; ///< most values of an attribute that is read

std::optional<StoredType> stored_type_of_netcdf(nc_type type, bool without_sign) {
    switch (type) {
    case NC_BYTE: return without_sign ? StoredType::u8 : StoredType::i8;
    case NC_UBYTE: return StoredType::u8;
    case NC_SHORT: return without_sign ? StoredType::u16 : StoredType::i16;
    case NC_USHORT: return StoredType::u16;
    case NC_INT: return without_sign ? StoredType::u32 : StoredType::i32;
    case NC_UINT: return StoredType::u32;
    case NC_INT64: return without_sign ? StoredType::u64 : StoredType::i64;
    case NC_UINT64: return StoredType::u64;
    case NC_FLOAT: return StoredType::f32;
    case NC_DOUBLE: return StoredType::f64;
    default: return std::nullopt;
    }
}

/// Type and number of values of an attribute; 0 values if there is none.
std::pair<nc_type, std::size_t> attribute_shape(const NetcdfVariable& variable, const char* name) {
    nc_type type = NC_NAT;
    std::size_t count = 0;
    if (nc_inq_att(variable.group, variable.id, name, &type, &count) != NC_NOERR ||
        count > kMostAttribute)
        return {NC_NAT, 0};
    return {type, count};
}

} // namespace

std::string text(const NetcdfVariable& variable) {
    std::vector<std::string> dimensions;
    for (const NetcdfDimension& dimension : variable.dimensions)
        dimensions.push_back(fmt::format("{} {}", dimension.name, dimension.length));
    return fmt::format("{}({})", variable.name, fmt::join(dimensions, ", "));
}

NetcdfFile::NetcdfFile(const fs::path& path, bool parts) : path_(path), name_(path.string()) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // or HDF5 prints what NetCDF does not find
    if (is_classic_netcdf(path))
        expect_whole_classic_netcdf(path);
    else if (head_of(path, 8) != "\x89HDF\r\n\x1a\n")
        throw Error("{}: not NetCDF: it starts neither with CDF nor as HDF5 does", name_);
    constexpr std::size_t kSmallestBlock = 256; // that the library has for classic files
    std::size_t block = parts ? kSmallestBlock : NC_SIZEHINT_DEFAULT;
    expect(nc__open(name_.c_str(), NC_NOWRITE, &block, &file_), "damaged or truncated");
    try {
        add_group(file_, {});
    } catch (...) {
        nc_close(file_);
        throw;
    }
}

NetcdfFile::~NetcdfFile() {
    nc_close(file_);
}

void NetcdfFile::add_group(int group, const std::string& prefix) {
    const std::string where = fmt::format("damaged group {}", prefix.empty() ? "/" : prefix);
    int count = 0;
    expect(nc_inq_varids(group, &count, nullptr), where);
    std::vector<int> ids(static_cast<std::size_t>(count));
    expect(nc_inq_varids(group, &count, ids.data()), where);
    char name[NC_MAX_NAME + 1]{};
    for (const int id : ids) {
        NetcdfVariable variable{.group = group, .id = id};
        nc_type type = NC_NAT;
        int dimensions = 0;
        expect(nc_inq_var(group, id, name, &type, &dimensions, nullptr, nullptr), where);
        variable.name = prefix + name;
        std::vector<int> dimension_ids(static_cast<std::size_t>(dimensions));
        expect(nc_inq_vardimid(group, id, dimension_ids.data()), where);
        for (const int dimension : dimension_ids) {
            std::size_t length = 0;
            expect(nc_inq_dim(group, dimension, name, &length), where);
            variable.dimensions.push_back({name, length});
        }
        variable.type =
            stored_type_of_netcdf(type, lower_case(text(variable, "_Unsigned")) == "true");
        variables_.push_back(std::move(variable));
    }
    expect(nc_inq_grps(group, &count, nullptr), where);
    std::vector<int> groups(static_cast<std::size_t>(count));
    expect(nc_inq_grps(group, &count, groups.data()), where);
    for (const int inner : groups) {
        expect(nc_inq_grpname(inner, name), where);
        add_group(inner, fmt::format("{}{}/", prefix, name));
    }
}

std::vector<const NetcdfVariable*> NetcdfFile::along(const NetcdfVariable& of,
                                                     const NetcdfDimension& dimension) const {
    std::vector<const NetcdfVariable*> numbers, texts;
    std::string prefix = of.name.substr(0, of.name.rfind('/') + 1);
    while (true) {
        for (const NetcdfVariable& variable : variables_) {
            const auto& along = variable.dimensions;
            if (along.empty() || along.front() != dimension || along.size() > 2 ||
                !variable.name.starts_with(prefix) ||
                variable.name.find('/', prefix.size()) != std::string::npos)
                continue;
            if (!variable.type)
                texts.push_back(&variable);
            else if (along.size() == 1)
                numbers.push_back(&variable);
        }
        if (prefix.empty())
            break;
        prefix.pop_back();
        prefix.resize(prefix.rfind('/') + 1);
    }
    numbers.insert(numbers.end(), texts.begin(), texts.end());
    return numbers;
}

NetcdfVariable NetcdfFile::at(const std::string& path) const {
    const auto named = std::ranges::find(variables_, path, &NetcdfVariable::name);
    if (named != variables_.end())
        return *named;
    NetcdfVariable group{.group = file_, .id = NC_GLOBAL};
    if (!path.empty())
        expect(nc_inq_grp_full_ncid(file_, ("/" + path).c_str(), &group.group), path);
    return group;
}

std::vector<std::string> NetcdfFile::texts(const NetcdfVariable& variable) const {
    constexpr std::size_t kLongest = 64, kMost = 1 << 20; // characters of a date, texts
    nc_type type = NC_NAT;
    const std::string what = fmt::format("{} cannot be read", variable.name);
    expect(nc_inq_vartype(variable.group, variable.id, &type), what);
    const auto& along = variable.dimensions;
    const bool of_characters = type == NC_CHAR && !along.empty();
    const std::size_t count =
        along.size() > (of_characters ? 1 : 0) ? along.front().length : std::size_t{1};
    std::vector<std::string> found;
    if (count == 0 || count > kMost)
        return found;
    if (type == NC_STRING && along.size() <= 1) {
        std::vector<char*> strings(count);
        expect(nc_get_var_string(variable.group, variable.id, strings.data()), what);
        for (const char* string : strings)
            found.emplace_back(trimmed(string ? string : ""));
        nc_free_string(count, strings.data());
    } else if (of_characters && along.size() <= 2 && along.back().length <= kLongest) {
        const std::size_t length = along.back().length;
        std::string all(count * length, '\0');
        expect(nc_get_var_text(variable.group, variable.id, all.data()), what);
        for (std::size_t i = 0; i < count; ++i)
            found.emplace_back(trimmed(all.substr(i * length, length).c_str()));
    }
    return found;
}

std::vector<std::string> NetcdfFile::attributes(const NetcdfVariable& variable) const {
    int count = 0;
    expect(nc_inq_varnatts(variable.group, variable.id, &count), variable.name);
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) {
        std::string name(NC_MAX_NAME + 1, '\0');
        expect(nc_inq_attname(variable.group, variable.id, i, name.data()), variable.name);
        names.emplace_back(name.c_str());
    }
    return names;
}

std::string NetcdfFile::text(const NetcdfVariable& variable, const char* attribute) const {
    const auto [type, count] = attribute_shape(variable, attribute);
    std::string found(count, '\0');
    if (type == NC_CHAR && count > 0) {
        expect(nc_get_att_text(variable.group, variable.id, attribute, found.data()), attribute);
    } else if (type == NC_STRING && count == 1) {
        char* string = nullptr;
        expect(nc_get_att_string(variable.group, variable.id, attribute, &string), attribute);
        found = string ? string : "";
        nc_free_string(1, &string);
    } else {
        return {};
    }
    found.resize(std::min(found.find('\0'), found.size())); // writers in C include the zero byte
    std::ranges::replace(found, '\n', ' ');
    return std::string(trimmed(found));
}

std::vector<std::string> NetcdfFile::texts(const NetcdfVariable& variable,
                                           const char* attribute) const {
    const auto [type, count] = attribute_shape(variable, attribute);
    if (type != NC_STRING || count == 0)
        return {};
    std::vector<char*> strings(count);
    expect(nc_get_att_string(variable.group, variable.id, attribute, strings.data()), attribute);
    std::vector<std::string> found;
    for (const char* string : strings)
        found.emplace_back(string ? string : "");
    nc_free_string(count, strings.data());
    return found;
}

std::vector<double> NetcdfFile::numbers(const NetcdfVariable& variable,
                                        const char* attribute) const {
    const auto [type, count] = attribute_shape(variable, attribute);
    std::vector<double> found(count);
    if (!stored_type_of_netcdf(type, false) || count == 0)
        return {};
    expect(nc_get_att_double(variable.group, variable.id, attribute, found.data()), attribute);
    return found;
}

bool NetcdfFile::is_real(const NetcdfVariable& variable, const char* attribute) const {
    const nc_type type = attribute_shape(variable, attribute).first;
    return type == NC_FLOAT || type == NC_DOUBLE;
}

std::optional<double> NetcdfFile::fill(const NetcdfVariable& variable) const {
    if (!numbers(variable, "_FillValue").empty())
        return std::nullopt; // the file names it
    if (variable.type == StoredType::f32 || variable.type == StoredType::f64)
        return NC_FILL_FLOAT; // also the fill value of f64
    return std::nullopt;
}

std::vector<double> NetcdfFile::values(const NetcdfVariable& variable) const {
    std::size_t count = 1;
    for (const NetcdfDimension& dimension : variable.dimensions)
        count *= dimension.length;
    std::vector<double> values(count);
    expect(nc_get_var_double(variable.group, variable.id, values.data()),
           fmt::format("{} cannot be read", variable.name));
    return values;
}

void NetcdfFile::read(const NetcdfVariable& variable, std::span<const std::size_t> start,
                      std::span<const std::size_t> count, std::span<std::byte> out) const {
    expect(nc_get_vara(variable.group, variable.id, start.data(), count.data(), out.data()),
           fmt::format("{} cannot be read", variable.name));
}

std::vector<std::size_t> NetcdfFile::chunk_of(const NetcdfVariable& variable) const {
    int storage = NC_CONTIGUOUS;
    std::vector<std::size_t> chunk(variable.dimensions.size());
    expect(nc_inq_var_chunking(variable.group, variable.id, &storage, chunk.data()),
           fmt::format("{}: damaged storage", variable.name));
    return storage == NC_CHUNKED ? chunk : std::vector<std::size_t>{};
}

void NetcdfFile::keep_chunks(const NetcdfVariable& variable, std::size_t time) const {
    const std::vector<std::size_t> chunk = chunk_of(variable);
    if (chunk.empty() || chunk[time] == 1)
        return;
    // Bytes of a chunk, chunks of a step.
    double bytes = static_cast<double>(size_of(*variable.type)), chunks = 1;
    for (std::size_t i = 0; i < chunk.size(); ++i) {
        bytes *= static_cast<double>(chunk[i]);
        if (i != time)
            chunks *= std::ceil(static_cast<double>(variable.dimensions[i].length) /
                                static_cast<double>(chunk[i]));
    }
    constexpr double kMostBytes = 512.0 * (1 << 20), kMostChunks = 1e6;
    if (bytes * chunks > kMostBytes || chunks > kMostChunks)
        return;
    constexpr std::size_t kSlotsPerChunk = 10; // as HDF5 advises
    constexpr float kPreferRead = 1.0f;        // evict chunks that have been read completely first
    expect(nc_set_var_chunk_cache(
               variable.group, variable.id, static_cast<std::size_t>(bytes * chunks),
               static_cast<std::size_t>(chunks) * kSlotsPerChunk + 1, kPreferRead),
           fmt::format("{}: no room for its chunks", variable.name));
}

void NetcdfFile::expect_room(const NetcdfVariable& variable) const {
    if (is_classic_netcdf(path_))
        return; // its length has been checked
    const std::vector<std::size_t> chunk = chunk_of(variable);
    Compression compression = Compression::none;
    double bytes = static_cast<double>(size_of(*variable.type)), chunk_bytes = bytes;
    for (const NetcdfDimension& dimension : variable.dimensions)
        bytes *= static_cast<double>(dimension.length);
    if (!chunk.empty()) {
        // Chunks that were never written take no room; they are treated as deflated.
        compression = Compression::deflate;
        std::size_t filters = 0;
        expect(nc_inq_var_filter_ids(variable.group, variable.id, &filters, nullptr),
               fmt::format("{}: damaged storage", variable.name));
        std::vector<unsigned> ids(filters);
        expect(nc_inq_var_filter_ids(variable.group, variable.id, &filters, ids.data()),
               fmt::format("{}: damaged storage", variable.name));
        constexpr unsigned kDeflateShuffleFletcher = 3; // 1, 2 and 3; others have unknown ratios
        if (std::ranges::any_of(ids, [](unsigned id) { return id > kDeflateShuffleFletcher; }))
            compression = Compression::bzip2;
        for (const std::size_t length : chunk)
            chunk_bytes *= static_cast<double>(length);
    }
    constexpr double kMost = 1e18; // beyond any file, within 64 bits
    index::expect_room(path_, 0, compression,
                       static_cast<std::uint64_t>(std::min(std::max(bytes, chunk_bytes), kMost)));
}

void NetcdfFile::expect(int status, const std::string& what) const {
    if (status != NC_NOERR)
        throw Error("{}: {}: {}", name_, what, nc_strerror(status));
}

} // namespace isochron::index
