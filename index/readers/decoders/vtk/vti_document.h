// What the markup of a VTK XML image file says: its grid, its pieces, and where the values of their arrays stand.
#pragma once

#include "index/readers/decoders/vtk/vti_values.h"
#include "index/system/mapped_file.h"

#include <array>
#include <string>
#include <vector>

namespace isochron::index {

/// First and last vertex along each axis.
using VtiExtent = std::array<int, 6>;

struct VtiArray {
    StoredArray array;
    VtiPlace place;
};

struct VtiPiece {
    VtiExtent extent{};
    std::vector<VtiArray> points, cells;

    const std::vector<VtiArray>& arrays(bool on_cells) const { return on_cells ? cells : points; }
};

struct VtiDocument {
    VtiEncoding encoding;
    VtiExtent extent{};
    std::array<double, 3> origin{0, 0, 0}, spacing{1, 1, 1};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1}; ///< row by row
    std::vector<VtiPiece> pieces;
    std::vector<VtiArray> fields; ///< field data of one number each
};

/// Parses the markup of a file. The places of values are in the file's memory.
/// @param markup that has been checked, see xml_markup.h
/// @throws Error naming the file
VtiDocument vti_document(const MappedFile& file, std::string_view markup, const std::string& name);

} // namespace isochron::index
