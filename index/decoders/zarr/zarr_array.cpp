// Chunks of Zarr arrays.
#include "index/decoders/zarr/zarr_array.h"

#include "index/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace isochron::index {
namespace {

using nlohmann::json;

constexpr std::size_t kMostChunk = std::size_t{4} << 30; ///< [bytes]

std::size_t product(const std::vector<std::uint64_t>& sizes, std::size_t element,
                    const std::string& where) {
    double bytes = static_cast<double>(element);
    for (const std::uint64_t size : sizes)
        bytes *= static_cast<double>(size);
    if (bytes > static_cast<double>(kMostChunk))
        throw Error(fmt::format("{}: chunks of {} values, expected at most {} bytes", where,
                                fmt::join(sizes, " x "), kMostChunk));
    return static_cast<std::size_t>(bytes);
}

std::optional<json> json_at(const ZarrStore& store, const std::string& key) {
    const auto bytes = store.read(key);
    if (!bytes)
        return std::nullopt;
    constexpr std::size_t kLargest = 64 << 20;
    auto parsed = bytes->size() > kLargest
                      ? json(json::value_t::discarded)
                      : json::parse(reinterpret_cast<const char*>(bytes->data()),
                                    reinterpret_cast<const char*>(bytes->data()) + bytes->size(),
                                    nullptr, false);
    if (!parsed.is_object())
        throw Error(fmt::format("{}: {} is no JSON object", store.name(), key));
    return parsed;
}

/// `<f4`, `|u1`, `>i2` of version 2; `float32` of version 3.
std::optional<StoredType> type_of_zarr(std::string name) {
    if (name.size() == 3 && std::string("<>|").find(name[0]) != std::string::npos)
        name.erase(0, 1);
    for (const auto& [known, type] : std::initializer_list<std::pair<const char*, StoredType>>{
             {"b1", StoredType::u8},      {"bool", StoredType::u8},     {"i1", StoredType::i8},
             {"int8", StoredType::i8},    {"u1", StoredType::u8},       {"uint8", StoredType::u8},
             {"i2", StoredType::i16},     {"int16", StoredType::i16},   {"u2", StoredType::u16},
             {"uint16", StoredType::u16}, {"i4", StoredType::i32},      {"int32", StoredType::i32},
             {"u4", StoredType::u32},     {"uint32", StoredType::u32},  {"i8", StoredType::i64},
             {"int64", StoredType::i64},  {"u8", StoredType::u64},      {"uint64", StoredType::u64},
             {"f4", StoredType::f32},     {"float32", StoredType::f32}, {"f8", StoredType::f64},
             {"float64", StoredType::f64}})
        if (name == known)
            return type;
    return std::nullopt;
}

std::string joined(const std::string& group, const std::string& name) {
    return group.empty() ? name : group + "/" + name;
}

} // namespace

std::string ZarrArray::where(const std::string& what) const {
    return fmt::format("{}: {}", store_->name(), joined(path_, what));
}

std::optional<ZarrArray> ZarrArray::open(const ZarrStore& store, const std::string& path) {
    ZarrArray array(store, path);
    try {
        if (const auto v3 = json_at(store, joined(path, "zarr.json"))) {
            if (v3->value("node_type", "") != "array")
                return std::nullopt;
            array.describe_v3(*v3);
        } else if (const auto v2 = json_at(store, joined(path, ".zarray"))) {
            array.describe_v2(*v2);
        } else {
            return std::nullopt;
        }
    } catch (const json::exception& error) {
        throw Error(fmt::format("{}: damaged description: {}", array.where(""), error.what()));
    }
    array.check();
    return array;
}

void ZarrArray::check() const {
    const std::size_t rank = shape_.size();
    if (chunk_.size() != rank || (!inner_.empty() && inner_.size() != rank) || rank > 16)
        throw Error(fmt::format("{}: {} dimensions, chunks of {}", where(""), rank, chunk_.size()));
    for (std::size_t i = 0; i < rank; ++i)
        if (chunk_[i] == 0 || (!inner_.empty() && (inner_[i] == 0 || chunk_[i] % inner_[i] != 0)))
            throw Error(fmt::format("{}: chunks of {}, in it {}", where(""),
                                    fmt::join(chunk_, " x "), fmt::join(inner_, " x ")));
    if (type_)
        product(chunk(), size_of(*type_), where(""));
}

bool ZarrArray::keeps_whole(std::span<const std::size_t> dimensions) const {
    const std::size_t bytes = type_ ? values_in_chunk() * size_of(*type_) : 0;
    return bytes > kLarge && bytes <= kKept &&
           std::ranges::all_of(dimensions, [&](std::size_t i) { return chunk()[i] >= shape_[i]; });
}

void ZarrArray::fill_with(const json& value) {
    double number = 0;
    if (value.is_number())
        number = value.get<double>();
    else if (value == "NaN")
        number = std::numeric_limits<double>::quiet_NaN();
    else if (value == "Infinity" || value == "-Infinity")
        number = value == "Infinity" ? HUGE_VAL : -HUGE_VAL;
    if (!value.is_null())
        fill_number_ = number;
    if (type_)
        visit_stored_type(*type_, [&]<class T>(std::type_identity<T>) {
            T fill{};
            if constexpr (std::is_floating_point_v<T>)
                fill = static_cast<T>(number);
            else if (value.is_number_integer())
                fill = static_cast<T>(value.get<std::int64_t>());
            fill_.resize(sizeof(T));
            std::memcpy(fill_.data(), &fill, sizeof(T));
        });
}

std::vector<std::size_t> ZarrArray::lengths_in(const json& list) const {
    for (const json& length : list)
        if (!length.is_number_unsigned())
            throw Error(fmt::format("{}: {}, expected a whole number", where(""), length.dump()));
    return list.get<std::vector<std::size_t>>();
}

void ZarrArray::describe_v2(const json& j) {
    shape_ = lengths_in(j.at("shape"));
    chunk_ = lengths_in(j.at("chunks"));
    const json& dtype = j.at("dtype");
    const std::string name = dtype.is_string() ? dtype.get<std::string>() : "";
    type_ = type_of_zarr(name);
    pipeline_.big_endian = name.starts_with('>');
    separator_ = j.value("dimension_separator", ".");
    if (j.value("order", "C") == "F")
        for (std::size_t i = shape_.size(); i-- > 0;)
            pipeline_.order.push_back(i);
    const std::size_t element = type_ ? size_of(*type_) : 1;
    if (const auto compressor = j.find("compressor");
        compressor != j.end() && !compressor->is_null())
        pipeline_.codecs.push_back(codec_of(compressor->at("id"), element, where("")));
    if (const auto filters = j.find("filters"); filters != j.end() && filters->is_array())
        for (auto filter = filters->rbegin(); filter != filters->rend(); ++filter)
            pipeline_.codecs.push_back(
                codec_of(filter->at("id"), filter->value("elementsize", element), where("")));
    fill_with(j.value("fill_value", json()));
    attributes_ = json_at(*store_, joined(path_, ".zattrs")).value_or(json::object());
    if (const auto names = attributes_.find("_ARRAY_DIMENSIONS");
        names != attributes_.end() && names->is_array() && names->size() == shape_.size())
        names->get_to(names_);
}

void ZarrArray::describe_v3(const json& j) {
    shape_ = lengths_in(j.at("shape"));
    const json& type = j.at("data_type");
    type_ = type_of_zarr(type.is_string() ? type.get<std::string>() : "");
    const json& grid = j.at("chunk_grid");
    if (grid.at("name") != "regular")
        throw Error(fmt::format("{}: a chunk grid {}, expected regular", where(""),
                                grid.at("name").dump()));
    chunk_ = lengths_in(grid.at("configuration").at("chunk_shape"));
    const json encoding = j.value("chunk_key_encoding", json::object());
    const bool slashes = encoding.value("name", "default") == "default";
    prefix_ = slashes ? "c" : "";
    separator_ =
        encoding.value("configuration", json::object()).value("separator", slashes ? "/" : ".");
    pipeline_ = pipeline_v3(j.at("codecs"), true);
    fill_with(j.value("fill_value", json()));
    attributes_ = j.value("attributes", json::object());
    if (const auto names = j.find("dimension_names"); names != j.end() && names->is_array())
        for (const json& name : *names)
            names_.push_back(name.is_string() ? name.get<std::string>() : "");
}

ZarrArray::Pipeline ZarrArray::pipeline_v3(const json& codecs, bool outer) {
    Pipeline pipeline;
    const std::size_t element = type_ ? size_of(*type_) : 1;
    for (const json& codec : codecs) {
        const std::string name =
            codec.is_string() ? codec.get<std::string>() : codec.at("name").get<std::string>();
        const json configuration =
            codec.is_object() ? codec.value("configuration", json::object()) : json::object();
        if (name == "bytes")
            pipeline.big_endian = configuration.value("endian", "little") == "big";
        else if (name == "transpose")
            pipeline.order = lengths_in(configuration.at("order"));
        else if (name == "sharding_indexed" && outer && codecs.size() == 1)
            take_shard(configuration);
        else
            pipeline.codecs.insert(pipeline.codecs.begin(), codec_of(name, element, where("")));
    }
    std::vector<std::size_t> sorted = pipeline.order;
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (sorted.size() != shape_.size() || sorted[i] != i)
            throw Error(
                fmt::format("{}: transposed by {}", where(""), fmt::join(pipeline.order, " ")));
    return inner_.empty() || !outer ? pipeline : pipeline_;
}

void ZarrArray::take_shard(const json& configuration) {
    inner_ = lengths_in(configuration.at("chunk_shape"));
    pipeline_ = pipeline_v3(configuration.at("codecs"), false);
    index_ = pipeline_v3(configuration.at("index_codecs"), false);
    index_at_end_ = configuration.value("index_location", "end") == "end";
}

std::string ZarrArray::key_of(std::span<const std::uint64_t> at) const {
    std::string key = prefix_;
    for (const std::uint64_t number : at)
        key += (key.empty() ? "" : separator_) + std::to_string(number);
    return joined(path_, at.empty() && key.empty() ? "0" : key);
}

std::size_t ZarrArray::values_in_chunk() const {
    std::size_t values = 1;
    for (const std::uint64_t length : chunk())
        values *= length;
    return values;
}

/// Makes values of stored bytes.
void ZarrArray::decode_chunk(const std::string& name, ZarrBytes& values) {
    const std::size_t size = size_of(*type_), bytes = values_in_chunk() * size;
    // A check adds to what comes out of the codecs before it.
    constexpr std::size_t kSlack = 64;
    for (const ZarrCodec& codec : pipeline_.codecs)
        decode(codec, bytes + kSlack, name, values, spare_);
    if (spare_.capacity() > kLarge)
        spare_ = {};
    if (values.size() != bytes)
        throw Error(fmt::format("{}: {} bytes, expected {}", name, values.size(), bytes));
    if (pipeline_.big_endian)
        for (std::size_t i = 0; i < bytes; i += size)
            std::reverse(values.begin() + static_cast<std::ptrdiff_t>(i),
                         values.begin() + static_cast<std::ptrdiff_t>(i + size));
    if (pipeline_.order.empty())
        return;
    transpose(values, spare_);
    values.swap(spare_);
}

/// Stored dimension i is dimension order[i]: walks through the values as they are stored.
void ZarrArray::transpose(const ZarrBytes& stored, ZarrBytes& out) const {
    const std::size_t rank = chunk().size(), size = size_of(*type_), bytes = stored.size();
    const std::vector<std::size_t>& order = pipeline_.order;
    std::vector<std::size_t> stride(rank, 1), at(rank, 0);
    for (std::size_t i = rank - 1; i-- > 0;)
        stride[i] = stride[i + 1] * chunk()[i + 1];
    out.resize(bytes);
    for (std::size_t from = 0; from < bytes; from += size) {
        std::size_t to = 0;
        for (std::size_t i = 0; i < rank; ++i)
            to += at[i] * stride[order[i]];
        std::memcpy(&out[to * size], &stored[from], size);
        for (std::size_t i = rank; i-- > 0;) {
            if (++at[i] < chunk()[order[i]])
                break;
            at[i] = 0;
        }
    }
}

/// @param values empty: only the fill value
void ZarrArray::load(const std::vector<std::uint64_t>& at, ZarrBytes& values) {
    if (!inner_.empty())
        return load_from_shard(at, values);
    const std::string key = key_of(at);
    if (store_->read(key, values))
        decode_chunk(fmt::format("{}: {}", store_->name(), key), values);
    else
        values.clear();
}

/// Some values of a chunk that is stored as it is.
/// @param first of the values in the chunk @return false where there is no such chunk
bool ZarrArray::load_part(const std::vector<std::uint64_t>& at, std::size_t first,
                          std::span<std::byte> values) const {
    const std::string key = key_of(at);
    const std::size_t size = size_of(*type_), bytes = values_in_chunk() * size;
    const auto stored = store_->size_of_value(key);
    if (!stored)
        return false;
    if (*stored != bytes)
        throw Error(
            fmt::format("{}: {}: {} bytes, expected {}", store_->name(), key, *stored, bytes));
    store_->part(key, first * size, values);
    return true;
}

const ZarrBytes& ZarrArray::chunk_at(const std::vector<std::uint64_t>& at) {
    if (const ZarrBytes* found = kept_.find(at))
        return *found;
    kept_.make_room(values_in_chunk() * size_of(*type_));
    ZarrBytes values;
    load(at, values);
    const std::size_t bytes = values.size();
    return kept_.keep(at, std::move(values), bytes);
}

void ZarrArray::read(std::span<const std::uint64_t> start, std::span<const std::uint64_t> count,
                     std::span<std::byte> out) {
    const std::size_t rank = shape_.size();
    std::vector<std::uint64_t> first(rank), last(rank), at;
    for (std::size_t i = 0; i < rank; ++i) {
        first[i] = start[i] / chunk()[i];
        last[i] = (start[i] + count[i] - 1) / chunk()[i];
    }
    at = first;
    while (true) {
        read_from_chunk(at, start, count, out);
        std::size_t i = rank;
        while (i > 0 && ++at[i - 1] > last[i - 1]) {
            at[i - 1] = first[i - 1];
            --i;
        }
        if (i == 0)
            return;
    }
}

/// The part of the box that lies in this chunk.
void ZarrArray::read_from_chunk(const std::vector<std::uint64_t>& at,
                                std::span<const std::uint64_t> start,
                                std::span<const std::uint64_t> count, std::span<std::byte> out) {
    const std::size_t rank = shape_.size(), size = size_of(*type_);
    std::vector<std::uint64_t> low(rank), high(rank);
    std::size_t wanted = 1;
    bool all = true;
    for (std::size_t i = 0; i < rank; ++i) {
        low[i] = std::max(start[i], at[i] * chunk()[i]);
        high[i] = std::min(start[i] + count[i], (at[i] + 1) * chunk()[i]);
        wanted *= high[i] - low[i];
        all = all && high[i] - low[i] ==
                         std::min(chunk()[i], shape_[i] - std::min(shape_[i], at[i] * chunk()[i]));
    }
    const auto place_in_chunk = [&](std::span<const std::uint64_t> p, std::uint64_t off) {
        std::size_t place = 0;
        for (std::size_t i = 0; i < rank; ++i)
            place = place * chunk()[i] + (p[i] - off - at[i] * chunk()[i]);
        return place;
    };
    const auto place_in_box = [&](std::span<const std::uint64_t> p, std::uint64_t off) {
        std::size_t place = 0;
        for (std::size_t i = 0; i < rank; ++i)
            place = place * count[i] + (p[i] - off - start[i]);
        return place;
    };
    // What lies in one piece both in the box and in a chunk that is plain goes straight there.
    const std::size_t from_low = place_in_chunk(low, 0), to_low = place_in_box(low, 0);
    const std::size_t stretch = place_in_chunk(high, 1) + 1 - from_low;
    if (plain() && stretch == wanted && place_in_box(high, 1) + 1 - to_low == wanted &&
        load_part(at, from_low, out.subspan(to_low * size, wanted * size)))
        return;
    // Of a chunk that is wanted as a whole nothing is left to keep it for; of one that is
    // stored as it is, only what is wanted is read.
    const std::size_t begin = all || !plain() ? 0 : from_low;
    if (all) {
        load(at, chunk_values_);
    } else if (plain()) {
        chunk_values_.resize(stretch * size);
        if (!load_part(at, begin, chunk_values_))
            chunk_values_.clear();
    }
    const ZarrBytes& values = all || plain() ? chunk_values_ : chunk_at(at);
    const std::size_t row = high[rank - 1] - low[rank - 1];
    for (std::vector<std::uint64_t> p = low;;) { // row by row along the last dimension
        const std::size_t to = place_in_box(p, 0), from = place_in_chunk(p, 0) - begin;
        if (!values.empty())
            std::memcpy(&out[to * size], &values[from * size], row * size);
        else
            for (std::size_t i = 0; i < row; ++i)
                std::memcpy(&out[(to + i) * size], fill_.data(), size);
        std::size_t i = rank - 1;
        while (i > 0 && ++p[i - 1] >= high[i - 1]) {
            p[i - 1] = low[i - 1];
            --i;
        }
        if (i == 0)
            return;
    }
}

} // namespace isochron::index
