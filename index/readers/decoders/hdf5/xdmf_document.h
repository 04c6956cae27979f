// What an XDMF document says of its grids, versions 2 and 3.
//
// https://www.xdmf.org/index.php/XDMF_Model_and_Format.html
#pragma once

#include "index/readers/formats/series/block_places.h"
#include "index/readers/formats/stored_scalar.h"
#include "index/volume/volume_series.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

/// Numbers that stand in the document, in a dataset of an HDF5 file, or in a plain file.
struct XdmfItem {
    enum class Where : std::uint8_t { document, hdf5, plain };

    /// The document that has the item; other files are relative to its folder.
    std::filesystem::path document;
    Where where = Where::document;
    StoredType type = StoredType::f32;
    std::vector<std::uint64_t> dimensions; ///< slowest first
    std::string text;                      ///< the numbers, `file.h5:/path`, or the file
    std::uint64_t seek = 0;                ///< [bytes] in a plain file
    bool big_endian = false;
    /// Where a hyperslab begins in the dataset, and its sizes; empty: the whole dataset.
    std::vector<std::uint64_t> start = {}, count = {};
};

struct XdmfAttribute {
    std::string name, type; ///< as stated: `rho`, `Scalar`
    bool on_cells = false;
    XdmfItem item;
};

/// A block of a step's grid.
struct XdmfPart {
    BlockSize begin{}; ///< its first vertex in the whole grid
    Grid grid;
    std::vector<XdmfAttribute> attributes;
};

/// One step.
struct XdmfGrid {
    Grid grid;
    std::vector<std::string> notes;
    std::optional<double> time;
    std::string date;            ///< in place of the time, which is 0 then
    std::vector<XdmfPart> parts; ///< one, or the parts of a spatial collection
};

/// All steps of a document and of those that it includes. Coordinates that are not in the document
/// are read from HDF5 files.
/// @throws Error naming the file and what is wrong: no XDMF, damaged, other grids than uniform and
///         rectilinear ones of three dimensions, several grids at a time that do not tile one
std::vector<XdmfGrid> read_xdmf(const std::filesystem::path& path);

/// The numbers of a short item. @throws Error naming the document
std::vector<double> numbers_of_item(const XdmfItem& item);

} // namespace isochron::index
