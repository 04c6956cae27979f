// What files of VTK state besides values and places: units, other field data.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <string>
#include <string_view>

class vtkDataObject;

namespace isochron::index {

/// Takes the unit of the chosen array, and a note on what is stated and not used, from the text of
/// an XML file up to its appended data.
void take_fields_of_markup(std::string_view markup, const ChosenScalar& chosen, SeriesInfo& info);

/// Takes unit and note from what VTK has read.
void take_fields_of_vtk(vtkDataObject& data, const ChosenScalar& chosen, SeriesInfo& info);

} // namespace isochron::index
