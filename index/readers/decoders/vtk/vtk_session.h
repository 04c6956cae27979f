// What the formats read with VTK share: turns its messages into errors, and its arrays into ours.
#pragma once

#include "index/readers/decoders/decoded_file.h"
#include "index/readers/decoders/vtk/vtk_ghosts.h"
#include "index/readers/decoders/vtk/vtk_image.h"
#include "index/readers/formats/stored_scalar.h"

#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkFieldData;
class vtkDataSet;
class vtkOutputWindow;

namespace isochron::index {

/// Runs `work`; VTK's messages are collected instead of printed.
/// @throws Error with the file and VTK's first error, in one line, also when memory runs out
void with_vtk(const std::filesystem::path& file, const std::function<void()>& work);

/// The stored type of an array type of VTK; none for types that are not numbers.
std::optional<StoredType> stored_type_of_vtk(int type);

/// Converts slices of the chosen array of an image that has been read; for cell data, all slices.
/// @param hidden see `hidden_by_flags`
/// @throws Error naming the file when the array is absent or not as long as the image
void values_of_vtk(vtkDataSet& image, const ChosenScalar& chosen, const Grid& grid, Slices slices,
                   std::span<const std::uint8_t> hidden, std::span<std::byte> out,
                   const std::string& file);

/// Flags of an image that has been read, of as many points and cells as the grid has.
GhostFlags flags_of_vtk(vtkDataSet& image, const Grid& grid);

/// Arrays of an image that has been read.
std::vector<StoredArray> arrays_of_vtk(vtkDataSet& image);

/// Sets the time from the field data, if they have one: `TimeValue` (ParaView), `TIME` (VisIt) or
/// `TimeStep`. If it is not `TimeValue`, a note says so.
void take_time_of_vtk(vtkFieldData* fields, SeriesInfo& info);

} // namespace isochron::index
