// What files of VTK state besides values and places: units, other field data.
#pragma once

#include "index/readers/formats/stored_scalar.h"
#include "index/readers/formats/unread_fields.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

class vtkDataObject;

namespace isochron::index {

/// Field data that give the time, the first of those that are there: of ParaView, of VisIt and of others.
inline constexpr std::array kTimeFields{"TimeValue", "TIME", "TimeStep"};
/// Ranges of values that VTK writes with each array.
inline constexpr std::array kRanges{"L2_NORM_RANGE", "L2_NORM_FINITE_RANGE", "COMPONENT_RANGE",
                                    "FINITE_RANGE", "DISCRETE_VALUES"};
/// The key of an array's unit.
inline constexpr std::string_view kUnit = "UNITS_LABEL";

inline bool is_one_of(const auto& list, std::string_view word) {
    return std::ranges::any_of(list, [&](std::string_view one) { return one == word; });
}

/// Fields as `note_on_unread` takes them, each said once.
class UnreadFields {
  public:
    void add(const std::string& key, std::string_view value);
    void tell(SeriesInfo& info) const;

  private:
    std::set<std::string> seen_;
    std::vector<std::string> fields_;
};

/// Takes the unit of the chosen array, and a note on what is stated and not used, from the text of
/// an XML file up to its appended data.
void take_fields_of_markup(std::string_view markup, const ChosenScalar& chosen, SeriesInfo& info);

/// Takes unit and note from what VTK has read.
void take_fields_of_vtk(vtkDataObject& data, const ChosenScalar& chosen, SeriesInfo& info);

} // namespace isochron::index
