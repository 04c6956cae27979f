// Knows units of length.
#include "index/readers/formats/length_units.h"

#include "index/lower_case.h"
#include "index/readers/formats/text_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace isochron::index {
namespace {

struct LengthUnit {
    std::string_view sign;
    std::string_view names; ///< each between bars, in lower case
    double meters;
};

constexpr std::array<LengthUnit, 22> kLengthUnits{{
    {"m", "|meter|metre|meters|metres|", 1},
    {"km", "|kilometer|kilometre|kilometers|kilometres|", 1e3},
    {"Mm", "|megameter|megametre|megameters|megametres|", 1e6},
    {"dm", "|decimeter|decimetre|decimeters|decimetres|", 1e-1},
    {"cm", "|centimeter|centimetre|centimeters|centimetres|", 1e-2},
    {"mm", "|millimeter|millimetre|millimeters|millimetres|", 1e-3},
    {"um",
     "|micron|microns|micrometer|micrometre|micrometers|micrometres|\u00b5m|\u03bcm|\xb5m|\u00b5|"
     "\u03bc|",
     1e-6},
    {"nm", "|nanometer|nanometre|nanometers|nanometres|", 1e-9},
    {"pm", "|picometer|picometre|picometers|picometres|", 1e-12},
    {"angstrom",
     "|angstroms|\u00c5|\u212b|\u00e5|\xc5|A|ang|\u00e5ngstr\u00f6m|\u00c5ngstr\u00f6m|", 1e-10},
    {"bohr", "|bohrs|a0|", 5.29177210903e-11}, // CODATA 2018
    {"in", "|inch|inches|", 0.0254},
    {"ft", "|foot|feet|", 0.3048},
    {"yd", "|yard|yards|", 0.9144},
    {"mi", "|mile|miles|", 1609.344},
    {"thou", "|mil|mils|", 2.54e-5},
    {"fm", "|femtometer|femtometre|femtometers|femtometres|", 1e-15},
    {"ua", "|au|astronomical unit|", 149597870700.0},
    {"pc", "|parsec|parsecs|", 3.0856775814913673e16},
    {"kpc", "|kiloparsec|kiloparsecs|", 3.0856775814913673e19},
    {"Mpc", "|megaparsec|megaparsecs|", 3.0856775814913673e22},
    {"ly", "|light year|light years|", 9.4607304725808e15},
}};

/// The text with the characters in place of `\u00B5`, `&#181;` and `&#xB5;`.
std::string without_escapes(const std::string& text) {
    std::string plain;
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view rest = std::string_view(text).substr(at);
        const bool by_code = rest.starts_with("\\u"), by_entity = rest.starts_with("&#");
        const bool by_hex = by_code || rest.starts_with("&#x") || rest.starts_with("&#X");
        const std::size_t begin = by_entity && by_hex ? 3 : 2;
        std::uint32_t code = 0;
        const char* const first = rest.data() + std::min(begin, rest.size());
        const char* const last = by_code ? rest.data() + std::min<std::size_t>(6, rest.size())
                                         : rest.data() + rest.size();
        const auto [end, failure] = std::from_chars(first, last, code, by_hex ? 16 : 10);
        const bool whole = by_code ? end == first + 4 : end != last && *end == ';';
        constexpr std::uint32_t kOneByte = 0x80, kTwoBytes = 0x800, kThreeBytes = 0x10000;
        if ((!by_code && !by_entity) || failure != std::errc() || !whole || code >= kThreeBytes) {
            plain += text[at++];
            continue;
        }
        if (code < kOneByte) {
            plain += static_cast<char>(code);
        } else if (code < kTwoBytes) {
            plain += static_cast<char>(0xc0 | code >> 6);
            plain += static_cast<char>(0x80 | (code & 0x3f));
        } else {
            plain += static_cast<char>(0xe0 | code >> 12);
            plain += static_cast<char>(0x80 | (code >> 6 & 0x3f));
            plain += static_cast<char>(0x80 | (code & 0x3f));
        }
        at = static_cast<std::size_t>(end - text.data()) + (by_code ? 0 : 1);
    }
    return plain;
}

const LengthUnit* known_unit(std::string_view escaped) {
    const std::string unit = without_escapes(std::string(trimmed(escaped)));
    // Signs differ in case: Mm is no mm.
    if (const auto by_sign = std::ranges::find(kLengthUnits, unit, &LengthUnit::sign);
        by_sign != kLengthUnits.end())
        return by_sign;
    const std::string name = "|" + lower_case(std::string(unit)) + "|",
                      as_is = "|" + std::string(unit) + "|";
    const auto by_name = std::ranges::find_if(kLengthUnits, [&](const LengthUnit& each) {
        return each.names.find(name) != each.names.npos ||
               each.names.find(as_is) != each.names.npos;
    });
    return by_name == kLengthUnits.end() ? nullptr : by_name;
}

/// Whether it is none at all.
bool counts_vertices(const std::string& unit) {
    const std::string lower = lower_case(unit);
    return lower == "pixel" || lower == "pixels" || lower == "voxel" || lower == "voxels" ||
           lower == "reference frame" || lower == "px";
}

} // namespace

std::optional<double> meters_in(std::string_view unit) {
    const LengthUnit* known = known_unit(unit);
    return known ? std::optional(known->meters) : std::nullopt;
}

std::string tidy_length_unit(const std::string& unit) {
    if (counts_vertices(unit))
        return "";
    const LengthUnit* known = known_unit(unit);
    return known ? std::string(known->sign) : unit;
}

} // namespace isochron::index
