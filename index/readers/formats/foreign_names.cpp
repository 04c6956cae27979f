// Signatures of other programs' formats; of FITS and NumPy also where plain values lie.
#include "index/readers/formats/foreign_names.h"

#include "index/lower_case.h"
#include "index/readers/formats/length_units.h"
#include "index/readers/formats/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

namespace isochron::index {
namespace {

using namespace std::string_view_literals;

/// What makes a format that is read of another one.
constexpr std::string_view kByBioFormats = "bfconvert IN OUT.ome.tif of Bio-Formats makes OME-TIFF "
                                           "of it",
                           kByDcm2niix = "dcm2niix FOLDER makes NIfTI of it";

struct Signature {
    std::size_t at;
    std::string_view bytes, name, way_out = {};
};

constexpr std::array kSignatures{
    Signature{0, "\x0e\x03\x13\x01"sv, "HDF4, not HDF5", "h4toh5 IN OUT.h5 makes HDF5 of it"},
    Signature{0, "MATLAB 5.0 MAT-file"sv, "a MATLAB file before version 7.3",
              "save('OUT.mat', '-v7.3') in MATLAB makes HDF5 of it"},
    Signature{0, "GRIB"sv, "GRIB", "cdo -f nc copy IN OUT.nc makes NetCDF of it"},
    Signature{0, "BUFR"sv, "BUFR"},
    Signature{0, "root\0"sv, "ROOT"},
    Signature{0, "ZISRAWFILE"sv, "Zeiss CZI", kByBioFormats},
    Signature{0, "\x70\0\0\0"sv, "Leica LIF", kByBioFormats},
    Signature{0, "\xda\xce\xbe\x0a"sv, "Nikon ND2", kByBioFormats},
    Signature{0, "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"sv,
              "an OLE2 file, as Olympus OIB, Zeiss ZVI and TXM of X-ray microscopes are",
              kByBioFormats},
    Signature{0, "# === DATA DESCRIPTION FILE"sv, "Philips PAR/REC", kByDcm2niix},
    Signature{0, ">>> Begin of header <<<"sv, "a spectrum of Siemens (RDA)",
              "spec2nii rda IN makes NIfTI of it"},
    Signature{0, "\x1f\x8b"sv, "compressed by gzip", "gzip -dc IN > OUT makes the plain file"},
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
};

/// Ends of names of files without a signature of their own.
constexpr std::array kNameEnds{
    Signature{0, ".dm3"sv, "Gatan DM3", kByBioFormats},
    Signature{0, ".dm4"sv, "Gatan DM4", kByBioFormats},
    Signature{0, ".oif"sv, "Olympus OIF", kByBioFormats},
    Signature{0, ".vsi"sv, "Olympus VSI", kByBioFormats},
    Signature{0, ".sld"sv, "SlideBook", kByBioFormats},
    Signature{0, ".pic"sv, "Bio-Rad PIC", kByBioFormats},
    Signature{0, ".nd"sv, "MetaMorph's list of .stk files", kByBioFormats},
    Signature{0, ".rec"sv, "values of Philips PAR/REC, or of another program", kByDcm2niix},
    Signature{0, ".brik.gz"sv, "AFNI", "3dAFNItoNIFTI IN makes NIfTI of it"},
    Signature{0, ".brik"sv, "AFNI", "3dAFNItoNIFTI IN makes NIfTI of it"},
    Signature{0, ".head"sv, "AFNI", "3dAFNItoNIFTI IN makes NIfTI of it"},
    Signature{0, "/2dseq"sv, "Bruker ParaVision", "brkraw tonii FOLDER makes NIfTI of it"},
    Signature{
        0, "/attributes.json"sv, "N5",
        "python3 -c \"import zarr; zarr.save('OUT.zarr', zarr.open('IN.n5')['PATH'][:])\" with "
        "zarr 2 makes Zarr of an array, without its spacing"},
};

template <class T>
T number_at(std::string_view bytes, std::size_t at) {
    T number{};
    if (at + sizeof(T) <= bytes.size())
        std::memcpy(&number, bytes.data() + at, sizeof(T));
    return number;
}

std::string other(std::string_view name, std::string_view way_out = {}) {
    return fmt::format(
        "{}, expected a format that is read: NRRD, NIfTI, VTK, HDF5 or another one of "
        "the guide's{}{}",
        name, way_out.empty() ? "" : "; ", way_out);
}

/// How headerless values can be read.
struct PlainValues {
    std::array<std::int64_t, 3> dims{}; ///< x fastest
    std::string type;                   ///< as `--type` takes it; empty: none that it takes
    std::uint64_t header = 0;           ///< [bytes]
    std::string more;                   ///< further options, each with a blank before it
    std::string lost = {};              ///< what the file states and no option can say
};

std::string named(const std::string& name, const std::optional<PlainValues>& values) {
    if (!values || values->type.empty() ||
        std::ranges::any_of(values->dims, [](std::int64_t size) { return size < 2; }))
        return other(name);
    return fmt::format("{}, whose values --dims {} {} {} --type {} --header-bytes {}{} reads{}{}",
                       name, values->dims[0], values->dims[1], values->dims[2], values->type,
                       values->header, values->more, values->lost.empty() ? "" : ", without its",
                       values->lost);
}

using Cards = std::map<std::string, std::string, std::less<>>;

/// Adds the options that place the values, or what of the place they cannot say.
void say_place_of_fits(const Cards& cards, PlainValues& values) {
    std::array<double, 3> spacing{1, 1, 1}, origin{};
    std::array<std::string, 3> units;
    bool placed = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto number = [&](const char* key, double otherwise) {
            const auto card = cards.find(fmt::format("{}{}", key, axis + 1));
            placed = placed || card != cards.end();
            return card == cards.end() ? otherwise : std::atof(card->second.c_str());
        };
        spacing[axis] = number("CDELT", 1);
        origin[axis] = number("CRVAL", 0) + (1 - number("CRPIX", 1)) * spacing[axis];
        if (const auto unit = cards.find(fmt::format("CUNIT{}", axis + 1)); unit != cards.end())
            units[axis] =
                trimmed(std::string_view(unit->second).substr(1, unit->second.rfind('\'') - 1));
    }
    const bool sayable =
        std::ranges::all_of(spacing, [](double step) { return step > 0; }) &&
        std::ranges::all_of(units, [&](const auto& unit) { return unit == units[0]; });
    if (placed && sayable)
        values.more += fmt::format(" --spacing {} {} {} --origin {} {} {}", spacing[0], spacing[1],
                                   spacing[2], origin[0], origin[1], origin[2]);
    if (placed && sayable && meters_in(units[0]))
        values.more += fmt::format(" --length-unit {}", units[0]);
    const auto is_lost = [&](const std::string& key) {
        const auto starts = [&](std::string_view begin) { return key.starts_with(begin); };
        const bool is_matrix = (starts("CD") || starts("PC")) && key.size() > 2 &&
                               std::isdigit(static_cast<unsigned char>(key[2])) != 0;
        return is_matrix || starts("CROTA") || starts("BLANK") ||
               (!sayable && (starts("CDELT") || starts("CRVAL") || starts("CRPIX")));
    };
    for (const auto& [key, value] : cards)
        if (is_lost(key))
            values.lost += " " + key;
}

// "The FITS standard", cards of 80 bytes in blocks of 2880.
std::string fits(FileStart& start) {
    constexpr std::size_t kCard = 80, kBlock = 2880, kMost = 100 * kBlock;
    const std::string_view bytes = start.bytes(kMost);
    Cards cards;
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
    say_place_of_fits(cards, values);
    return named("FITS", values);
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
    const std::map<std::string_view, std::string> types{{"b1", "u8"},  {"i1", "i8"},  {"u1", "u8"},
                                                        {"i2", "i16"}, {"u2", "u16"}, {"i4", "i32"},
                                                        {"f4", "f32"}, {"f8", "f64"}};
    const std::size_t quote = descr.find('\'');
    const auto type = quote == descr.npos
                          ? types.end()
                          : types.find(std::string_view(descr).substr(quote + 2, 2));
    const bool by_columns = std::string(trimmed(after("'fortran_order'"))).starts_with("True");
    if (sizes.size() == 4 && !by_columns)
        sizes.erase(sizes.begin()); // its steps follow each other
    if (sizes.size() == 3 && type != types.end()) {
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
    if (has(0, "\x93NUMPY"))
        return numpy(start);
    if (has(0, "ISOCHRON"))
        return "an index, which is not read together with files: give it alone; `isochron build "
               "FILES -o INDEX --append` adds files to it";
    if (head.find("<SpimData") != head.npos)
        return other("BigDataViewer's description", "give the .h5 file beside it");
    for (const Signature& signature : kSignatures)
        if (has(signature.at, signature.bytes))
            return other(signature.name, signature.way_out);
    return {};
}

std::string foreign_format_or_name(FileStart& start) {
    const std::string told = foreign_format_of(start);
    if (!told.empty() && !told.starts_with("compressed"))
        return told;
    const std::string name = lower_case(start.path().string());
    for (const Signature& signature : kNameEnds)
        if (name.ends_with(signature.bytes))
            return other(signature.name, signature.way_out);
    return told;
}

} // namespace isochron::index
