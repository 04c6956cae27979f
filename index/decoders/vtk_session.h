// What the formats read through VTK share: its messages as errors, its arrays as ours.
#pragma once

#include "index/decoders/decoded_file.h"
#include "index/formats/stored_scalar.h"

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

/// Runs `work` while VTK's messages are collected instead of printed.
/// @throws Error with the file and VTK's first error, in one line, also when memory runs out
void with_vtk(const std::filesystem::path& file, const std::function<void()>& work);

/// An array type of VTK, none for those that are no numbers.
std::optional<StoredType> stored_type_of_vtk(int type);

/// Grid of an image; an extent that does not start at 0 moves the origin.
/// @param extent first and last vertex per axis
/// @param direction row by row, as VTK has it
Grid grid_of_vtk(const int (&extent)[6], const double* origin, const double* spacing,
                 const double* direction, const std::string& file);

/// Converts slices of the chosen array of an image that has been read; of cell data all.
/// @param hidden see `hidden_by_flags`
/// @throws Error naming the file when the array is absent or not as long as the image
void values_of_vtk(vtkDataSet& image, const ChosenScalar& chosen, const Grid& grid, Slices slices,
                   std::span<const std::uint8_t> hidden, std::span<std::byte> out,
                   const std::string& file);

/// As `DecodedFile` has them.
std::uint32_t slices_of_vtk(const ChosenScalar& chosen, const SeriesInfo& info);
std::uint64_t bytes_of_vtk(const ChosenScalar& chosen, const Grid& grid);

/// Arrays of an image that has been read.
std::vector<StoredArray> arrays_of_vtk(vtkDataSet& image);

/// The time that the field data give, if they do: `TimeValue` as ParaView writes it, `TIME` as VisIt
/// does, or `TimeStep`; of the others a note says so.
void take_time_of_vtk(vtkFieldData* fields, SeriesInfo& info);

} // namespace isochron::index
