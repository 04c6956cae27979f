// Knows units of length.
#include "index/readers/formats/length_units.h"

#include "index/lower_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace isochron::index {
namespace {

struct LengthUnit {
    std::string_view sign;
    std::string_view names; ///< each between bars, in lower case
    double meters;
};

constexpr std::array<LengthUnit, 21> kLengthUnits{{
    {"m", "|meter|metre|meters|metres|", 1},
    {"km", "|kilometer|kilometre|kilometers|kilometres|", 1e3},
    {"Mm", "|megameter|megametre|megameters|megametres|", 1e6},
    {"dm", "|decimeter|decimetre|decimeters|decimetres|", 1e-1},
    {"cm", "|centimeter|centimetre|centimeters|centimetres|", 1e-2},
    {"mm", "|millimeter|millimetre|millimeters|millimetres|", 1e-3},
    {"um",
     "|micron|microns|micrometer|micrometre|micrometers|micrometres|\u00b5m|\u03bcm|\\u00b5m|"
     "\xb5m|&#181;m|",
     1e-6},
    {"nm", "|nanometer|nanometre|nanometers|nanometres|", 1e-9},
    {"pm", "|picometer|picometre|picometers|picometres|", 1e-12},
    {"angstrom", "|angstroms|\u00c5|\u212b|ang|\u00e5ngstr\u00f6m|", 1e-10},
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

const LengthUnit* known_unit(std::string_view unit) {
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
    return lower == "pixel" || lower == "pixels" || lower == "reference frame" || lower == "px";
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

OneLengthUnit one_length_unit(const std::array<std::string, 3>& units) {
    OneLengthUnit one;
    std::array<std::string, 3> tidy;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        tidy[axis] = tidy_length_unit(units[axis]);
        if (one.unit.empty())
            one.unit = tidy[axis];
    }
    const auto meters = meters_in(one.unit);
    bool convertible = true, differ = false;
    for (int axis = 0; axis < 3; ++axis) {
        std::string& unit = tidy[static_cast<std::size_t>(axis)];
        if (const std::string& stated = units[static_cast<std::size_t>(axis)];
            counts_vertices(stated) && !one.unit.empty())
            unit = stated;
        if (unit.empty() || unit == one.unit)
            continue;
        differ = true;
        const auto of_axis = meters_in(unit);
        if (meters && of_axis)
            one.factor[axis] = *of_axis / *meters;
        else
            convertible = false;
    }
    if (differ)
        one.notes.push_back(
            convertible
                ? fmt::format("lengths along x, y and z are in {}, {} and {}: all are given "
                              "in {}",
                              tidy[0], tidy[1], tidy[2], one.unit)
                : fmt::format("lengths along x, y and z are in {}, {} and {}, which have no "
                              "known proportion: their numbers are kept; --spacing sets "
                              "others",
                              tidy[0], tidy[1], tidy[2]));
    return one;
}

} // namespace isochron::index
