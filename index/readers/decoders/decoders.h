// The formats that libraries decode: one function for each, in a separate file.
#pragma once

#include "index/readers/decoders/decoded_file.h"

namespace isochron::index {

/// VTK XML image data (.vti) in all encodings and with all compressors.
std::unique_ptr<DecodedFile> decode_vti(const std::filesystem::path& path,
                                        const ReadOptions& options);

/// Legacy VTK structured points (.vtk).
std::unique_ptr<DecodedFile> decode_vtk(const std::filesystem::path& path,
                                        const ReadOptions& options);

/// VTK's rectilinear grids (.vtr, legacy), files of several pieces (.pvti, .pvtr), and, where they
/// are to be resampled, other grids (.vtu, .vts, .pvtu, .pvts, .vtm, .vth, .vthb, legacy).
std::unique_ptr<DecodedFile> decode_vtk_data(const std::filesystem::path& path,
                                             const ReadOptions& options);

/// Meshes of simulations where they are to be resampled: Exodus, CGNS, OpenFOAM, AMReX.
std::unique_ptr<DecodedFile> decode_mesh(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// NetCDF, classic and 4.
std::unique_ptr<DecodedFile> decode_netcdf(const std::filesystem::path& path,
                                           const ReadOptions& options);

/// HDF5 datasets by their path, VTKHDF image data and openPMD meshes.
std::unique_ptr<DecodedFile> decode_hdf5(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// XDMF documents (.xmf, .xdmf) of uniform and rectilinear grids.
std::unique_ptr<DecodedFile> decode_xdmf(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// TIFF, BigTIFF, OME-TIFF and ImageJ's hyperstacks; with `slices` a file for each slice.
std::unique_ptr<DecodedFile> decode_tiff(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// Zarr, versions 2 and 3, and OME-Zarr: a folder, the file in it that describes it, or a zip file.
std::unique_ptr<DecodedFile> decode_zarr(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// DICOM images: a file, or with `slices` the files of a series, put in the order of their places
/// and times.
std::unique_ptr<DecodedFile> decode_dicom(const std::filesystem::path& path,
                                          const ReadOptions& options);

/// What a ParaView collection (.pvd) lists. @throws Error naming the file
ListedFiles decode_pvd(const std::filesystem::path& path);

} // namespace isochron::index
