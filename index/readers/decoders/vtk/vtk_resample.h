// Puts VTK's curvilinear, unstructured and composite grids onto a regular one.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

class vtkDataObject;
class vtkDataSet;
class vtkImageData;

namespace isochron::index {

/// Calls `take` for each grid of a composite data set, or for the one grid of another.
void each_grid(vtkDataObject& data, const std::function<void(vtkDataSet&)>& take);

/// Vertices along each axis of a regular grid as fine as the smallest cell.
/// @throws Error naming the file: no cells, or too many vertices
std::array<std::uint32_t, 3> vertices_by_cells(vtkDataObject& data, const std::string& file);

/// Interpolated values on a regular grid; a vertex outside of all cells is hidden.
/// @param vertices along each axis, or `kBySmallestCell`
/// @throws Error naming the file: no cells, too many vertices by its smallest cell, arrays of other
///         lengths than their grid, points that are not finite
vtkSmartPointer<vtkImageData> onto_image(vtkDataObject& data,
                                         const std::array<std::uint32_t, 3>& vertices,
                                         const std::string& file);

/// Resamples the data onto the vertices of another image.
vtkSmartPointer<vtkImageData> onto_image_like(vtkDataObject& data, vtkImageData& like,
                                              const std::string& file);

/// The resolution, and how far the regular grid is from the data's own values at their points, or
/// at the centers of their cells.
/// @param hidden vertices of the regular grid, see `hidden_by_flags`
std::string note_on_resampling(vtkDataObject& data, vtkImageData& image, const ChosenScalar& chosen,
                               std::span<const std::uint8_t> hidden);

} // namespace isochron::index
