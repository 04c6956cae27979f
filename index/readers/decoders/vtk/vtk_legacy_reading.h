// Lets VTK read a legacy file with everything in it.
#pragma once

#include <filesystem>
#include <string>

class vtkDataReader;

namespace isochron::index {

/// The second line of a file.
std::string title_of(const std::filesystem::path& path);

/// Reads the grid and all arrays of a legacy file, also those whose infinities and NaN are text.
/// Call within `with_vtk`. @throws Error as `text_with_stand_ins`
void read_all(vtkDataReader& reader, const std::filesystem::path& path);

} // namespace isochron::index
