// Units of length and their meters.
#include "index/volume/length_unit.h"

#include "index/lower_case.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isochron::index {

std::optional<double> meters_in(std::string_view unit) {
    constexpr std::array<std::pair<std::string_view, double>, 20> kUnits{{
        {"m", 1},
        {"meter", 1},
        {"metre", 1},
        {"km", 1e3},
        {"kilometer", 1e3},
        {"kilometre", 1e3},
        {"cm", 1e-2},
        {"centimeter", 1e-2},
        {"centimetre", 1e-2},
        {"mm", 1e-3},
        {"millimeter", 1e-3},
        {"millimetre", 1e-3},
        {"um", 1e-6},
        {"micron", 1e-6},
        {"micrometer", 1e-6},
        {"micrometre", 1e-6},
        {"nm", 1e-9},
        {"nanometer", 1e-9},
        {"in", 0.0254},
        {"ft", 0.3048},
    }};
    std::string name = lower_case(unit);
    // In UTF-8: MICRO SIGN and GREEK SMALL LETTER MU.
    if (name == "\xc2\xb5m" || name == "\xce\xbcm")
        name = "um";
    if (name.size() > 2 && name.ends_with('s'))
        name.pop_back();
    const auto found = std::ranges::find(kUnits, name, &std::pair<std::string_view, double>::first);
    return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

} // namespace isochron::index
