// Reads what a Zarr array says of itself.
#include "index/readers/decoders/zarr/zarr_description.h"

#include "index/json_mistake.h"

#include "index/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <utility>

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
        throw Error("{}: chunks of {} values, expected at most {} bytes", where,
                    fmt::join(sizes, " x "), kMostChunk);
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
        throw Error("{}: {} is no JSON object", store.name(), key);
    return parsed;
}

/// The number of a text like `<U19`; 0: it is none, or a large one
std::size_t number_in(std::string_view text) {
    std::size_t number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    constexpr std::size_t kLongest = 4096;
    return failure == std::errc{} && end == text.data() + text.size() && number <= kLongest ? number
                                                                                            : 0;
}

/// Types of texts and dates: `|S19`, `<U19`, `<M8[ns]` and, packed by a filter, `|O` of version 2;
/// `string`, `fixed_length_utf32`, `null_terminated_bytes` and `numpy.datetime64` of version 3.
void take_text_type(const json& type, ZarrDescription& said) {
    if (!type.is_string() && !type.is_object())
        return; // a structure
    const std::string name = type.is_string() ? type.get<std::string>() : type.value("name", "");
    const json more =
        type.is_object() ? type.value("configuration", json::object()) : json::object();
    if (name == "string" || name == "|O") {
        said.texts = ZarrTexts::varying;
    } else if (name == "fixed_length_utf32" || name == "null_terminated_bytes") {
        said.texts = name.front() == 'f' ? ZarrTexts::utf32 : ZarrTexts::bytes;
        said.text_bytes = number_in(std::to_string(more.value("length_bytes", 0)));
    } else if (name == "numpy.datetime64") {
        said.date_unit = more.value("unit", "");
        said.date_factor = more.value("scale_factor", 1);
    } else if (name.size() > 2 && std::string_view("<>|").find(name[0]) != std::string_view::npos) {
        if (name[1] == 'S' || name[1] == 'U') {
            said.texts = name[1] == 'U' ? ZarrTexts::utf32 : ZarrTexts::bytes;
            said.text_bytes = number_in(name.substr(2)) * (name[1] == 'U' ? 4 : 1);
        } else if (name.substr(1, 3) == "M8[" && name.ends_with(']')) { // `<M8[25s]` counts 25 s
            const std::size_t unit = name.find_first_not_of("0123456789", 4);
            said.date_unit = name.substr(unit, name.size() - 1 - unit);
            said.date_factor = unit > 4 ? static_cast<std::int64_t>(
                                              number_in(std::string_view(name).substr(4, unit - 4)))
                                        : 1;
        }
    }
    if (!said.date_unit.empty()) {
        said.texts = ZarrTexts::dates;
        said.text_bytes = sizeof(std::int64_t);
    } else if (said.texts != ZarrTexts::varying &&
               (said.text_bytes == 0 ||
                (said.texts == ZarrTexts::utf32 && said.text_bytes % 4 != 0))) {
        said.texts = ZarrTexts::none;
    }
}

/// `<f4`, `|u1`, `>i2` of version 2; `float32` of version 3. Half floats become f32.
std::optional<StoredType> type_of_zarr(std::string name) {
    if (name.size() == 3 && std::string("<>|").find(name[0]) != std::string::npos)
        name.erase(0, 1);
    for (const auto& [known, type] : std::initializer_list<std::pair<const char*, StoredType>>{
             {"b1", StoredType::u8},  {"bool", StoredType::u8},
             {"i1", StoredType::i8},  {"int8", StoredType::i8},
             {"u1", StoredType::u8},  {"uint8", StoredType::u8},
             {"i2", StoredType::i16}, {"int16", StoredType::i16},
             {"u2", StoredType::u16}, {"uint16", StoredType::u16},
             {"i4", StoredType::i32}, {"int32", StoredType::i32},
             {"u4", StoredType::u32}, {"uint32", StoredType::u32},
             {"i8", StoredType::i64}, {"int64", StoredType::i64},
             {"u8", StoredType::u64}, {"uint64", StoredType::u64},
             {"f2", StoredType::f32}, {"float16", StoredType::f32},
             {"f4", StoredType::f32}, {"float32", StoredType::f32},
             {"f8", StoredType::f64}, {"float64", StoredType::f64}})
        if (name == known)
            return type;
    return std::nullopt;
}

class ZarrDescriber {
  public:
    ZarrDescriber(const ZarrStore& store, const std::string& path) : store_(store) {
        said_.path = path;
    }
    /// @return empty if there is no array
    std::optional<ZarrDescription> operator()();

  private:
    /// @throws Error when a number is not whole, or negative
    std::vector<std::size_t> lengths_in(const json& list) const;
    void describe_v2(const json& j);
    void describe_v3(const json& j);
    ZarrPipeline pipeline_v3(const json& codecs, bool outer);
    void take_shard(const json& configuration);
    void check() const;
    void fill_with(const json& value);
    /// Adds the next codec; one that is not known matters when values are read.
    void add_codec(ZarrPipeline& pipeline, const std::string& name, std::size_t element,
                   bool first);
    std::string where(const std::string& what) const;

    const ZarrStore& store_;
    ZarrDescription said_;
};

std::optional<ZarrDescription> ZarrDescriber::operator()() {
    try {
        if (const auto v3 = json_at(store_, zarr_key(said_.path, "zarr.json"))) {
            if (v3->value("node_type", "") != "array")
                return std::nullopt;
            describe_v3(*v3);
        } else if (const auto v2 = json_at(store_, zarr_key(said_.path, ".zarray"))) {
            describe_v2(*v2);
        } else {
            return std::nullopt;
        }
    } catch (const json::exception& error) {
        throw Error("{}: damaged description: {}", where(""), json_mistake(error));
    }
    check();
    return std::move(said_);
}

std::string ZarrDescriber::where(const std::string& what) const {
    const std::string key = zarr_key(said_.path, what);
    return key.empty() ? store_.name() : fmt::format("{}: {}", store_.name(), key);
}

void ZarrDescriber::check() const {
    const std::size_t rank = said_.shape.size();
    if (said_.chunk.size() != rank || (!said_.inner.empty() && said_.inner.size() != rank) ||
        rank > 16)
        throw Error("{}: {} dimensions, chunks of {}", where(""), rank, said_.chunk.size());
    for (std::size_t i = 0; i < rank; ++i)
        if (said_.chunk[i] == 0 ||
            (!said_.inner.empty() && (said_.inner[i] == 0 || said_.chunk[i] % said_.inner[i] != 0)))
            throw Error("{}: chunks of {}, in it {}", where(""), fmt::join(said_.chunk, " x "),
                        fmt::join(said_.inner, " x "));
    if (said_.type || said_.texts != ZarrTexts::none)
        product(said_.parts(), said_.half ? 4 : said_.element(), where(""));
}

void ZarrDescriber::fill_with(const json& value) {
    double number = 0;
    if (value.is_number())
        number = value.get<double>();
    else if (value == "NaN")
        number = std::numeric_limits<double>::quiet_NaN();
    else if (value == "Infinity" || value == "-Infinity")
        number = value == "Infinity" ? HUGE_VAL : -HUGE_VAL;
    if (!value.is_null())
        said_.fill_number = number;
    if (said_.type)
        visit_stored_type(*said_.type, [&]<class T>(std::type_identity<T>) {
            T fill{};
            if constexpr (std::is_floating_point_v<T>)
                fill = static_cast<T>(number);
            else if (value.is_number_integer())
                fill = static_cast<T>(value.get<std::int64_t>());
            said_.fill.resize(sizeof(T));
            std::memcpy(said_.fill.data(), &fill, sizeof(T));
        });
}

std::vector<std::size_t> ZarrDescriber::lengths_in(const json& list) const {
    for (const json& length : list)
        if (!length.is_number_unsigned())
            throw Error("{}: {}, expected a whole number", where(""), length.dump());
    return list.get<std::vector<std::size_t>>();
}

void ZarrDescriber::add_codec(ZarrPipeline& pipeline, const std::string& name, std::size_t element,
                              bool first) {
    if (name == "vlen-utf8" && said_.texts == ZarrTexts::varying)
        return; // their own layout, which is taken apart behind the others
    try {
        const ZarrCodec codec = codec_of(name, element, where(""));
        pipeline.codecs.insert(first ? pipeline.codecs.begin() : pipeline.codecs.end(), codec);
    } catch (const Error& error) {
        said_.unread = error.what();
    }
}

void ZarrDescriber::describe_v2(const json& j) {
    said_.shape = lengths_in(j.at("shape"));
    said_.chunk = lengths_in(j.at("chunks"));
    const json& dtype = j.at("dtype");
    const std::string name = dtype.is_string() ? dtype.get<std::string>() : "";
    said_.type = type_of_zarr(name);
    said_.type_name = dtype.is_string() ? name : dtype.dump();
    if (!said_.type)
        take_text_type(dtype, said_);
    said_.half = name.ends_with("f2");
    said_.pipeline.big_endian = name.starts_with('>');
    said_.separator = j.value("dimension_separator", ".");
    if (j.value("order", "C") == "F")
        for (std::size_t i = said_.shape.size(); i-- > 0;)
            said_.pipeline.order.push_back(i);
    const std::size_t element = said_.element();
    if (const auto compressor = j.find("compressor");
        compressor != j.end() && !compressor->is_null())
        add_codec(said_.pipeline, compressor->at("id"), element, false);
    if (const auto filters = j.find("filters"); filters != j.end() && filters->is_array())
        for (auto filter = filters->rbegin(); filter != filters->rend(); ++filter)
            add_codec(said_.pipeline, filter->at("id"), filter->value("elementsize", element),
                      false);
    fill_with(j.value("fill_value", json()));
    said_.attributes = json_at(store_, zarr_key(said_.path, ".zattrs")).value_or(json::object());
    if (const auto names = said_.attributes.find("_ARRAY_DIMENSIONS");
        names != said_.attributes.end() && names->is_array() && names->size() == said_.shape.size())
        names->get_to(said_.names);
}

void ZarrDescriber::describe_v3(const json& j) {
    said_.shape = lengths_in(j.at("shape"));
    const json& type = j.at("data_type");
    said_.type = type_of_zarr(type.is_string() ? type.get<std::string>() : "");
    said_.type_name = type.is_string() ? type.get<std::string>() : type.dump();
    if (!said_.type)
        take_text_type(type, said_);
    said_.half = said_.type_name == "float16";
    const json& grid = j.at("chunk_grid");
    if (grid.at("name") != "regular")
        throw Error("{}: a chunk grid {}, expected regular", where(""), grid.at("name").dump());
    said_.chunk = lengths_in(grid.at("configuration").at("chunk_shape"));
    const json encoding = j.value("chunk_key_encoding", json::object());
    const bool slashes = encoding.value("name", "default") == "default";
    said_.prefix = slashes ? "c" : "";
    said_.separator =
        encoding.value("configuration", json::object()).value("separator", slashes ? "/" : ".");
    said_.pipeline = pipeline_v3(j.at("codecs"), true);
    fill_with(j.value("fill_value", json()));
    said_.attributes = j.value("attributes", json::object());
    if (const auto names = j.find("dimension_names"); names != j.end() && names->is_array())
        for (const json& name : *names)
            said_.names.push_back(name.is_string() ? name.get<std::string>() : "");
}

ZarrPipeline ZarrDescriber::pipeline_v3(const json& codecs, bool outer) {
    ZarrPipeline pipeline;
    const std::size_t element = said_.element();
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
            add_codec(pipeline, name, element, true);
    }
    std::vector<std::size_t> sorted = pipeline.order;
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (sorted.size() != said_.shape.size() || sorted[i] != i)
            throw Error("{}: transposed by {}", where(""), fmt::join(pipeline.order, " "));
    return said_.inner.empty() || !outer ? pipeline : said_.pipeline;
}

void ZarrDescriber::take_shard(const json& configuration) {
    said_.inner = lengths_in(configuration.at("chunk_shape"));
    said_.pipeline = pipeline_v3(configuration.at("codecs"), false);
    said_.index = pipeline_v3(configuration.at("index_codecs"), false);
    said_.index_at_end = configuration.value("index_location", "end") == "end";
}

} // namespace

std::string zarr_key(const std::string& group, const std::string& name) {
    return group.empty() ? name : group + "/" + name;
}

std::optional<ZarrDescription> description_of_zarr(const ZarrStore& store,
                                                   const std::string& path) {
    return ZarrDescriber(store, path)();
}

} // namespace isochron::index
