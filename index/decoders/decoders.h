// The formats that libraries decode: one function for each, in a separate file.
#pragma once

#include "index/decoders/decoded_file.h"

#include <utility>
#include <vector>

namespace isochron::index {

/// VTK XML image data (.vti) in all encodings and with all compressors.
std::unique_ptr<DecodedFile> decode_vti(const std::filesystem::path& path,
                                        const ReadOptions& options);

/// Legacy VTK structured points (.vtk).
std::unique_ptr<DecodedFile> decode_vtk(const std::filesystem::path& path,
                                        const ReadOptions& options);

/// NetCDF, classic and 4.
std::unique_ptr<DecodedFile> decode_netcdf(const std::filesystem::path& path,
                                           const ReadOptions& options);

/// HDF5 datasets by their path, VTKHDF image data and openPMD meshes.
std::unique_ptr<DecodedFile> decode_hdf5(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// The files and times of a ParaView collection (.pvd), ordered by time. Paths are made relative to
/// the working directory. @throws Error naming the file
std::vector<std::pair<std::filesystem::path, double>> decode_pvd(const std::filesystem::path& path);

} // namespace isochron::index
