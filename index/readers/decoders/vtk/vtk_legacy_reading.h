// Lets VTK read a legacy file with everything in it.
#pragma once

#include <filesystem>

class vtkDataReader;

namespace isochron::index {

/// Reads the grid and all arrays of a legacy file, also those whose infinities and NaN are text.
/// Call within `with_vtk`. @throws Error as `text_with_stand_ins`
void read_all(vtkDataReader& reader, const std::filesystem::path& path);

} // namespace isochron::index
