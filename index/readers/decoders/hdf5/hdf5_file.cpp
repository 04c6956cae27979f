// Reads an HDF5 file through its library.
#include "index/readers/decoders/hdf5/hdf5_file.h"

#include "index/error.h"
#include "index/readers/decoders/hdf5/hdf5_filters.h"
#include "index/readers/formats/data_stream.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <hdf5.h>

#include <algorithm>
#include <exception>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

constexpr std::size_t kMostObjects = 200'000;
constexpr hssize_t kMostNumbers = 1 << 24, kMostAttribute = 1 << 16;

std::optional<StoredType> integer_type(std::size_t size, bool with_sign) {
    switch (size) {
    case 1: return with_sign ? StoredType::i8 : StoredType::u8;
    case 2: return with_sign ? StoredType::i16 : StoredType::u16;
    case 4: return with_sign ? StoredType::i32 : StoredType::u32;
    case 8: return with_sign ? StoredType::i64 : StoredType::u64;
    default: return std::nullopt;
    }
}

/// Half precision becomes f32, exactly.
std::optional<StoredType> stored_type_of_hdf5(hid_t type) {
    const std::size_t size = H5Tget_size(type);
    switch (H5Tget_class(type)) {
    case H5T_INTEGER: return integer_type(size, H5Tget_sign(type) == H5T_SGN_2);
    case H5T_FLOAT:
        if (size > 8)
            return std::nullopt;
        return size <= 4 ? StoredType::f32 : StoredType::f64;
    case H5T_ENUM: { // as h5py writes bool
        const Hdf5Handle base(H5Tget_super(type), H5Tclose);
        return base ? stored_type_of_hdf5(base.id()) : std::nullopt;
    }
    default: return std::nullopt;
    }
}

/// The library's message on an error, from the place where the error began.
std::string words_of_hdf5() {
    std::string words;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
            auto& text = *static_cast<std::string*>(found);
            if (text.empty() && error->desc)
                text = error->desc;
            return 0;
        },
        &words);
    H5Eclear2(H5E_DEFAULT);
    return words.empty() ? "the library does not say why" : words;
}

std::vector<std::uint64_t> dimensions_of(hid_t space) {
    const int rank = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> dimensions(static_cast<std::size_t>(std::max(rank, 0)));
    if (rank > 0)
        H5Sget_simple_extent_dims(space, dimensions.data(), nullptr);
    return {dimensions.begin(), dimensions.end()};
}

std::optional<Hdf5Dataset> described(hid_t dataset, std::string path) {
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
    if (!type || !space)
        return std::nullopt;
    return Hdf5Dataset{std::move(path), stored_type_of_hdf5(type.id()), dimensions_of(space.id())};
}

/// An open attribute, its type and its number of values.
struct Attribute {
    Hdf5Handle open, type;
    hssize_t count = 0;
};

std::optional<Attribute> attribute_of(hid_t file, const std::string& object,
                                      const std::string& name) {
    if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0)
        return std::nullopt;
    Attribute found{
        {H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose},
        {}};
    if (!found.open)
        return std::nullopt;
    found.type = {H5Aget_type(found.open.id()), H5Tclose};
    const Hdf5Handle space(H5Aget_space(found.open.id()), H5Sclose);
    found.count = space ? H5Sget_simple_extent_npoints(space.id()) : 0;
    if (!found.type || found.count < 1 || found.count > kMostAttribute)
        return std::nullopt;
    return found;
}

std::string tidy_text(std::string text) {
    text.resize(std::min(text.find('\0'), text.size()));
    std::ranges::replace_if(text, [](unsigned char c) { return c < ' '; }, ' ');
    return std::string(trimmed(text));
}

std::vector<std::string> fixed_texts(const Attribute& attribute) {
    const std::size_t length = H5Tget_size(attribute.type.id());
    if (length == 0 || length > 1 << 16)
        return {};
    std::string bytes(length * static_cast<std::size_t>(attribute.count), '\0');
    if (H5Aread(attribute.open.id(), attribute.type.id(), bytes.data()) < 0)
        return {};
    std::vector<std::string> texts;
    for (std::size_t at = 0; at < bytes.size(); at += length)
        texts.push_back(tidy_text(bytes.substr(at, length)));
    return texts;
}

std::vector<std::string> varying_texts(const Attribute& attribute) {
    std::vector<char*> read(static_cast<std::size_t>(attribute.count));
    const Hdf5Handle type(H5Tget_native_type(attribute.type.id(), H5T_DIR_ASCEND), H5Tclose);
    if (!type || H5Aread(attribute.open.id(), type.id(), read.data()) < 0)
        return {};
    std::vector<std::string> texts;
    for (const char* text : read)
        texts.push_back(text ? tidy_text(text) : "");
    const Hdf5Handle space(H5Aget_space(attribute.open.id()), H5Sclose);
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, read.data());
    return texts;
}

struct Visit {
    std::vector<std::string> paths;
    std::size_t objects = 0;
    std::exception_ptr failure;
};

} // namespace

std::string shape_text(const std::vector<std::uint64_t>& dimensions) {
    return dimensions.empty() ? "one value" : fmt::format("{}", fmt::join(dimensions, " x "));
}

Hdf5File::Hdf5File(const fs::path& path, bool parts) : name_(path.string()) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // or it prints an error for what is missing
    file_bytes(path);
    register_hdf5_filters();
    const htri_t is = H5Fis_hdf5(name_.c_str());
    if (is == 0)
        throw Error("{}: not HDF5: it does not start as HDF5 does", name_);
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // The library reads 64 KiB around every row of a part that is shorter than that.
    constexpr std::size_t kShortRow = 256;
    if (parts)
        H5Pset_sieve_buf_size(access.id(), kShortRow);
    file_ = {H5Fopen(name_.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose};
    expect(static_cast<bool>(file_), "damaged or truncated");
}

void Hdf5File::expect(bool good, const std::string& what) const {
    if (!good)
        throw Error("{}: {}: {}", name_, what, words_of_hdf5());
}

std::vector<Hdf5Dataset> Hdf5File::datasets() const {
    Visit visit;
    const herr_t status = H5Ovisit2(
        file_.id(), H5_INDEX_NAME, H5_ITER_INC,
        [](hid_t, const char* name, const auto* info, void* data) -> herr_t {
            auto& found = *static_cast<Visit*>(data);
            try {
                if (info->type == H5O_TYPE_DATASET)
                    found.paths.push_back(fmt::format("/{}", name));
                return ++found.objects > kMostObjects ? 1 : 0;
            } catch (...) {
                found.failure = std::current_exception();
                return -1;
            }
        },
        &visit, H5O_INFO_BASIC);
    if (visit.failure)
        std::rethrow_exception(visit.failure);
    expect(status >= 0, "damaged groups");
    if (status > 0)
        throw Error("{}: more than {} objects, choose one with --array /its/path", name_,
                    kMostObjects);
    std::vector<Hdf5Dataset> datasets;
    for (const std::string& path : visit.paths) {
        auto found = dataset(path);
        expect(found.has_value(), fmt::format("{} is damaged", path));
        datasets.push_back(std::move(*found));
    }
    return datasets;
}

std::optional<Hdf5Dataset> Hdf5File::dataset(const std::string& path) const {
    const Hdf5Handle object(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object || H5Iget_type(object.id()) != H5I_DATASET)
        return std::nullopt;
    return described(object.id(), path);
}

bool Hdf5File::holds(const std::string& path) const {
    return static_cast<bool>(Hdf5Handle(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), H5Oclose));
}

std::vector<double> Hdf5File::numbers(const std::string& object,
                                      const std::string& attribute) const {
    const auto found = attribute_of(file_.id(), object, attribute);
    if (!found || !stored_type_of_hdf5(found->type.id()))
        return {};
    std::vector<double> numbers(static_cast<std::size_t>(found->count));
    expect(H5Aread(found->open.id(), H5T_NATIVE_DOUBLE, numbers.data()) >= 0,
           fmt::format("attribute {} of {} cannot be read", attribute, object));
    return numbers;
}

bool Hdf5File::is_real(const std::string& object, const std::string& attribute) const {
    const auto found = attribute_of(file_.id(), object, attribute);
    return found && H5Tget_class(found->type.id()) == H5T_FLOAT;
}

std::vector<std::string> Hdf5File::texts(const std::string& object,
                                         const std::string& attribute) const {
    const auto found = attribute_of(file_.id(), object, attribute);
    if (!found || H5Tget_class(found->type.id()) != H5T_STRING)
        return {};
    return H5Tis_variable_str(found->type.id()) > 0 ? varying_texts(*found) : fixed_texts(*found);
}

std::string Hdf5File::text(const std::string& object, const std::string& attribute) const {
    const std::vector<std::string> found = texts(object, attribute);
    return found.size() == 1 ? found.front() : "";
}

std::vector<std::string> Hdf5File::attributes(const std::string& object) const {
    std::vector<std::string> names;
    if (holds(object))
        H5Aiterate_by_name(
            file_.id(), object.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
            [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
                try {
                    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
                } catch (...) {
                    return -1; // no memory: no exception passes through the library
                }
                return 0;
            },
            &names, H5P_DEFAULT);
    return names;
}

std::vector<double> Hdf5File::values(const Hdf5Dataset& dataset) const {
    const std::string what = fmt::format("{} cannot be read", dataset.path);
    const Hdf5Handle open(H5Dopen2(file_.id(), dataset.path.c_str(), H5P_DEFAULT), H5Dclose);
    expect(static_cast<bool>(open), what);
    const Hdf5Handle space(H5Dget_space(open.id()), H5Sclose);
    const hssize_t count = space ? H5Sget_simple_extent_npoints(space.id()) : 0;
    if (!dataset.type || count < 1 || count > kMostNumbers)
        throw Error("{}: {}: {} values, expected 1 to {} numbers", name_, dataset.path, count,
                    kMostNumbers);
    std::vector<double> values(static_cast<std::size_t>(count));
    expect(H5Dread(open.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
           what);
    return values;
}

std::vector<std::string> Hdf5File::texts_in(const std::string& path) const {
    const auto shape = dataset(path);
    const Hdf5Handle open(shape ? H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT) : -1, H5Dclose);
    const Hdf5Handle type(open ? H5Dget_type(open.id()) : -1, H5Tclose);
    const Hdf5Handle space(open ? H5Dget_space(open.id()) : -1, H5Sclose);
    const hssize_t count = space ? H5Sget_simple_extent_npoints(space.id()) : 0;
    if (!type || H5Tget_class(type.id()) != H5T_STRING || count < 1 || count > kMostNumbers)
        return {};
    const auto all = static_cast<std::size_t>(count),
               rows = shape->dimensions.empty() ? 1 : std::size_t{shape->dimensions.front()};
    constexpr std::size_t kLongest = 4096;
    const std::size_t length = H5Tget_size(type.id());
    const bool varying = H5Tis_variable_str(type.id()) > 0;
    if (varying ? all != rows
                : length < 1 || length > kLongest || all > std::size_t{kMostNumbers} / length)
        return {};
    std::vector<std::string> texts(rows);
    const std::string what = fmt::format("{} cannot be read", path);
    if (varying) {
        std::vector<char*> read(all);
        expect(H5Dread(open.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                       static_cast<void*>(read.data())) >= 0,
               what);
        for (std::size_t i = 0; i < all; ++i)
            texts[i] = read[i] ? tidy_text(read[i]) : "";
        H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, static_cast<void*>(read.data()));
        return texts;
    }
    std::string bytes(length * all, '\0');
    expect(H5Dread(open.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0, what);
    for (std::size_t i = 0; i < rows; ++i)
        texts[i] = tidy_text(bytes.substr(i * (bytes.size() / rows), bytes.size() / rows));
    return texts;
}

// After the HDF5 Dimension Scale Specification: DIMENSION_LIST holds references to scales.
std::vector<std::string> Hdf5File::scales(const Hdf5Dataset& dataset) const {
    std::vector<std::string> paths(dataset.dimensions.size());
    const auto found = attribute_of(file_.id(), dataset.path, "DIMENSION_LIST");
    if (!found || static_cast<std::size_t>(found->count) != paths.size() ||
        H5Tget_class(found->type.id()) != H5T_VLEN)
        return paths;
    const Hdf5Handle base(H5Tget_super(found->type.id()), H5Tclose);
    if (!base || H5Tequal(base.id(), H5T_STD_REF_OBJ) <= 0)
        return paths;
    std::vector<hvl_t> lists(paths.size());
    if (H5Aread(found->open.id(), found->type.id(), lists.data()) < 0)
        return paths;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        if (lists[i].len < 1)
            continue;
        char path[4096]{};
        const Hdf5Handle scale(
            H5Rdereference2(found->open.id(), H5P_DEFAULT, H5R_OBJECT, lists[i].p), H5Oclose);
        if (scale && H5Iget_name(scale.id(), path, sizeof path) > 0)
            paths[i] = path;
    }
    const Hdf5Handle space(H5Aget_space(found->open.id()), H5Sclose);
    H5Dvlen_reclaim(found->type.id(), space.id(), H5P_DEFAULT, lists.data());
    return paths;
}

} // namespace isochron::index
