// Tells the format of a file by its name, or by its first bytes.
#pragma once

#include "index/formats/volume_file.h"

namespace isochron::index {

/// Opens one file of a format. @throws Error naming the file
using OpenFormat = std::unique_ptr<VolumeFile> (*)(const std::filesystem::path&,
                                                   const ReadOptions&);

/// The format by the name's extension, in upper or lower case. If that is not known, HDF5, NetCDF,
/// NRRD and VTK's legacy files are recognized by their first bytes, as simulations write them under
/// names without an extension. `is_dicom` recognizes DICOM.
/// @param path of a file, or of the file that describes a Zarr folder
/// @return null: unknown, or it cannot be read
OpenFormat format_of(const std::filesystem::path& path);

/// Whether a file lists the files of a series instead of holding values: `.pvd` and `.series`.
bool lists_files(const std::filesystem::path& path);

/// Of a Zarr folder the file that describes it; else the path itself.
std::filesystem::path described_in(const std::filesystem::path& path);

} // namespace isochron::index
