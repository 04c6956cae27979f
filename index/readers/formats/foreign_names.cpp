// Signatures of other programs' formats; of FITS, MRC and NumPy also where plain values lie.
#include "index/readers/formats/foreign_names.h"

#include "index/lower_case.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

namespace isochron::index {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::size_t at;
    std::string_view bytes, name;
};

constexpr std::array kSignatures{
    Signature{0, "\x0e\x03\x13\x01"sv, "HDF4, not HDF5"},
    Signature{0, "MATLAB 5.0 MAT-file"sv, "a MATLAB file before version 7.3"},
    Signature{0, "MATLAB 7.3 MAT-file"sv, "a MATLAB 7.3 file, which is HDF5: name it .h5"},
    Signature{0, "GRIB"sv, "GRIB"},
    Signature{0, "BUFR"sv, "BUFR"},
    Signature{0, "root\0"sv, "ROOT"},
    Signature{0, "ZISRAWFILE"sv, "Zeiss CZI"},
    Signature{0, "\x70\0\0\0"sv, "Leica LIF"},
    Signature{0, "\xda\xce\xbe\x0a"sv, "Nikon ND2"},
    Signature{0, "\x89PNG"sv, "a PNG picture"},
    Signature{0, "\xff\xd8\xff"sv, "a JPEG picture"},
    Signature{4, "jP  "sv, "a JPEG 2000 picture"},
    Signature{0, "BM"sv, "a BMP picture"},
    Signature{0, " BDV"sv, "OpenVDB"},
    Signature{0, "#!TDV"sv, "Tecplot"},
    Signature{0, "#!SZPLT"sv, "Tecplot"},
    Signature{0, "$MeshFormat"sv, "Gmsh"},
    Signature{0, "# Amira"sv, "Amira"},
    Signature{0, "# Avizo"sv, "Avizo"},
    Signature{0, "ply\n"sv, "PLY, a surface and no volume"},
    Signature{0, "ply\r"sv, "PLY, a surface and no volume"},
    Signature{0, "solid "sv, "STL, a surface and no volume"},
    Signature{0, "%PDF"sv, "PDF"},
    Signature{0, "SQLite format 3"sv, "SQLite"},
    Signature{0, "PAR1"sv, "Parquet"},
    Signature{0, "Kaydara FBX"sv, "FBX"},
    Signature{0, "glTF"sv, "glTF"},
    Signature{0, "ISOCHRON"sv,
              "an index, which is not read together with files: give it alone; `isochron build "
              "FILES -o INDEX --append` adds files to it"},
};

template <class T>
T number_at(std::string_view bytes, std::size_t at) {
    T number{};
    if (at + sizeof(T) <= bytes.size())
        std::memcpy(&number, bytes.data() + at, sizeof(T));
    return number;
}

std::string other(std::string_view name) {
    if (name.find("name it") != name.npos || name.find("give it") != name.npos)
        return std::string(name);
    return fmt::format(
        "{}, expected a format that is read: NRRD, NIfTI, VTK, HDF5 or another one of "
        "the guide's",
        name);
}

/// How headerless values can be read.
struct PlainValues {
    std::array<std::int64_t, 3> dims{}; ///< x fastest
    std::string type;                   ///< as `--type` takes it; empty: none that it takes
    std::uint64_t header = 0;           ///< [bytes]
    std::string more;                   ///< further options, each with a blank before it
};

std::string named(const std::string& name, const std::optional<PlainValues>& values) {
    if (!values || values->type.empty() ||
        std::ranges::any_of(values->dims, [](std::int64_t size) { return size < 2; }))
        return other(name);
    return fmt::format("{}, whose values --dims {} {} {} --type {} --header-bytes {}{} reads", name,
                       values->dims[0], values->dims[1], values->dims[2], values->type,
                       values->header, values->more);
}

// "The FITS standard", cards of 80 bytes in blocks of 2880.
std::string fits(FileStart& start) {
    constexpr std::size_t kCard = 80, kBlock = 2880, kMost = 100 * kBlock;
    const std::string_view bytes = start.bytes(kMost);
    std::map<std::string, std::string, std::less<>> cards;
    std::size_t at = 0;
    for (; at + kCard <= bytes.size(); at += kCard) {
        const std::string_view card = bytes.substr(at, kCard);
        const std::string key(trimmed(card.substr(0, 8)));
        if (key == "END")
            break;
        cards.emplace(key, trimmed(card.substr(10, card.find('/', 10) - 10)));
    }
    const std::map<std::string_view, std::string> types{
        {"8", "u8"}, {"16", "i16"}, {"32", "i32"}, {"-32", "f32"}, {"-64", "f64"}};
    const auto type = types.find(cards["BITPIX"]);
    PlainValues values;
    values.header = (at / kBlock + 1) * kBlock;
    // The values are padded to whole blocks.
    values.more = " --big-endian --allow-surplus --steps 0:0";
    for (std::size_t axis = 0; axis < 3; ++axis)
        std::istringstream(cards[fmt::format("NAXIS{}", axis + 1)]) >> values.dims[axis];
    const bool plain = cards["NAXIS"] == "3" && !cards.contains("BSCALE") &&
                       !cards.contains("BZERO") && type != types.end();
    values.type = plain ? type->second : "";
    return named("FITS", values);
}

// "MRC2014 file format", little-endian.
std::string mrc(FileStart& start) {
    constexpr std::size_t kHeader = 1024;
    const std::string_view bytes = start.bytes(kHeader);
    PlainValues values;
    std::array<double, 3> spacing{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        values.dims[axis] = number_at<std::int32_t>(bytes, 4 * axis);
        const auto samples = number_at<std::int32_t>(bytes, 28 + 4 * axis);
        const double size = number_at<float>(bytes, 40 + 4 * axis);
        spacing[axis] = samples > 0 ? size / samples : 0;
    }
    const std::map<std::int32_t, std::string> types{{0, "i8"}, {1, "i16"}, {2, "f32"}, {6, "u16"}};
    const auto type = types.find(number_at<std::int32_t>(bytes, 12));
    const bool in_order =
        number_at<std::int32_t>(bytes, 64) == 1 && number_at<std::int32_t>(bytes, 68) == 2;
    const bool little = number_at<std::uint8_t>(bytes, 212) == 0x44;
    values.type = type != types.end() && in_order && little ? type->second : "";
    values.header = kHeader + number_at<std::uint32_t>(bytes, 92);
    if (std::ranges::all_of(spacing, [](double step) { return step > 0; }))
        values.more = fmt::format(" --spacing {:g} {:g} {:g} --length-unit angstrom", spacing[0],
                                  spacing[1], spacing[2]);
    return named("MRC", values);
}

// "NEP 1: a simple file format for NumPy arrays".
std::string numpy(FileStart& start) {
    constexpr std::size_t kMost = 1 << 12;
    const std::string_view bytes = start.bytes(kMost);
    const bool longer = number_at<std::uint8_t>(bytes, 6) > 1;
    PlainValues values;
    values.header = longer ? 12 + std::uint64_t{number_at<std::uint32_t>(bytes, 8)}
                           : 10 + std::uint64_t{number_at<std::uint16_t>(bytes, 8)};
    const std::string head(bytes.substr(0, values.header));
    const auto after = [&](const char* key) {
        const std::size_t at = head.find(key);
        return at == head.npos ? std::string() : head.substr(head.find(':', at) + 1);
    };
    std::istringstream shape(after("'shape'"));
    char mark = 0;
    std::vector<std::int64_t> sizes;
    shape >> mark;
    for (std::int64_t size = 0; shape >> size; shape >> mark)
        sizes.push_back(size);
    const std::string descr = after("'descr'");
    const std::map<std::string_view, std::string> types{{"i1", "i8"},  {"u1", "u8"},  {"i2", "i16"},
                                                        {"u2", "u16"}, {"i4", "i32"}, {"f4", "f32"},
                                                        {"f8", "f64"}};
    const std::size_t quote = descr.find('\'');
    const auto type = quote == descr.npos
                          ? types.end()
                          : types.find(std::string_view(descr).substr(quote + 2, 2));
    if (sizes.size() == 3 && type != types.end()) {
        const bool by_columns = std::string(trimmed(after("'fortran_order'"))).starts_with("True");
        values.dims = {sizes[2], sizes[1], sizes[0]};
        if (by_columns)
            std::ranges::reverse(values.dims);
        values.type = type->second;
        values.more = descr[quote + 1] == '>' ? " --big-endian" : "";
    }
    return named("a NumPy array", values);
}

} // namespace

std::string foreign_format_of(FileStart& start) {
    constexpr std::size_t kHead = 256;
    const std::string head(start.bytes(kHead));
    const auto has = [&](std::size_t at, std::string_view bytes) {
        return head.size() >= at + bytes.size() && head.compare(at, bytes.size(), bytes) == 0;
    };
    if (has(0, "SIMPLE  ="))
        return fits(start);
    if (has(208, "MAP ") || has(208, "MAP\0"sv))
        return mrc(start);
    if (has(0, "\x93NUMPY"))
        return numpy(start);
    for (const Signature& signature : kSignatures)
        if (has(signature.at, signature.bytes))
            return other(signature.name);
    // The start of TIFF tells nothing of what a program keeps in it under another name.
    if (has(0, "II*\0"sv) || has(0, "MM\0*"sv) || has(0, "II+\0"sv) || has(0, "MM\0+"sv))
        return "TIFF under another name: name it .tif";
    if (lower_case(start.path().string()).ends_with(".mgz"))
        return other("FreeSurfer's MGZ");
    if (lower_case(start.path().string()).ends_with(".mgh"))
        return other("FreeSurfer's MGH");
    return {};
}

} // namespace isochron::index
