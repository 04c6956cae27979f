// What images of VTK's formats share, whoever has read them: their grid, and the conversion of their tuples.
#pragma once

#include "index/readers/formats/stored_scalar.h"
#include "index/readers/process/reader_messages.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace isochron::index {

/// Grid of an image; an extent that does not start at 0 moves the origin.
/// @param extent first and last vertex along each axis
/// @param direction matrix in VTK's order, row by row
Grid grid_of_vtk(const int (&extent)[6], const double* origin, const double* spacing,
                 const double* direction, const std::string& file);

/// Number of tuples of the chosen array.
std::uint64_t tuples_of_vtk(const ChosenScalar& chosen, const Grid& grid);

/// `slices_at_once` and `decoded_bytes` of a `DecodedFile`.
std::uint32_t slices_of_vtk(const ChosenScalar& chosen, const SeriesInfo& info);
std::uint64_t bytes_of_vtk(const ChosenScalar& chosen, const Grid& grid);

/// Converts slices of an array to values of a series; for cell data, all slices.
/// @param tuples of these slices, in native byte order
/// @param hidden see `hidden_by_flags`, of the whole grid
void convert_slices(const ChosenScalar& chosen, std::span<const std::byte> tuples, const Grid& grid,
                    Slices slices, std::span<const std::uint8_t> hidden, std::span<std::byte> out,
                    const std::string& file);

} // namespace isochron::index
