// The formats that can be read: one function for each, in a separate file.
#pragma once

#include "index/formats/series/file_series.h"

namespace isochron::index {

/// Headerless values: `dims` and `type` come from the options. A file whose size is a multiple of
/// one step's size has several steps.
std::unique_ptr<VolumeFile> open_raw(const std::filesystem::path& path, const ReadOptions& options);

/// MetaImage: .mhd with its data beside it, .mha. Space is LPS, as in ITK.
std::unique_ptr<VolumeFile> open_metaimage(const std::filesystem::path& path,
                                           const ReadOptions& options);

/// VisIt's brick of values: .bov with its data beside it. Values of cells are taken at their
/// centers.
std::unique_ptr<VolumeFile> open_bov(const std::filesystem::path& path, const ReadOptions& options);

/// NRRD: .nrrd, .nhdr. The kinds of its axes say which are time and components; without kinds, a
/// slowest fourth axis is time.
std::unique_ptr<VolumeFile> open_nrrd(const std::filesystem::path& path,
                                      const ReadOptions& options);

/// NIfTI-1 and -2, and Analyze 7.5: .nii, .nii.gz, .hdr with .img, either of which names the pair.
/// The fourth axis is time. Space is RAS.
std::unique_ptr<VolumeFile> open_nifti(const std::filesystem::path& path,
                                       const ReadOptions& options);

/// VTK XML image data (.vti) and legacy structured points (.vtk), decoded in a reader process.
std::unique_ptr<VolumeFile> open_vti(const std::filesystem::path& path, const ReadOptions& options);
std::unique_ptr<VolumeFile> open_vtk(const std::filesystem::path& path, const ReadOptions& options);

/// VTK's rectilinear grids (.vtr), files of several pieces (.pvti, .pvtr), and, with `resample`,
/// its other grids (.vtu, .vts, .pvtu, .pvts, .vtm, .vth), in a reader.
std::unique_ptr<VolumeFile> open_vtk_data(const std::filesystem::path& path,
                                          const ReadOptions& options);

/// Meshes of simulations, which must be resampled: Exodus, CGNS, an OpenFOAM case (its .foam or
/// controlDict), an AMReX plotfile (its Header).
std::unique_ptr<VolumeFile> open_mesh(const std::filesystem::path& path,
                                      const ReadOptions& options);

/// NetCDF, classic and 4 (.nc, .nc4, .cdf), in a reader, where it was built with the library. Space
/// is that of the coordinate variables, with z up where a file says so.
std::unique_ptr<VolumeFile> open_netcdf(const std::filesystem::path& path,
                                        const ReadOptions& options);

/// HDF5 (.h5, .hdf5, .he5, .vtkhdf, .hdf), decoded in a reader process, if the build has the
/// library: datasets by their path, VTKHDF image data, openPMD meshes.
std::unique_ptr<VolumeFile> open_hdf5(const std::filesystem::path& path,
                                      const ReadOptions& options);

/// XDMF (.xmf, .xdmf) with values in HDF5 files, in plain files or in the document, in a reader.
std::unique_ptr<VolumeFile> open_xdmf(const std::filesystem::path& path,
                                      const ReadOptions& options);

/// TIFF and BigTIFF (.tif, .tiff), in a reader, where it was built with the library: pages as
/// slices, as OME-XML has them, or as ImageJ does.
std::unique_ptr<VolumeFile> open_tiff(const std::filesystem::path& path,
                                      const ReadOptions& options);

/// Zarr and OME-Zarr, in a reader: a zip file, or the file that describes a folder (`zarr.json`,
/// `.zattrs`, `.zarray`, `.zgroup`).
std::unique_ptr<VolumeFile> open_zarr(const std::filesystem::path& path,
                                      const ReadOptions& options);

/// DICOM (.dcm and by content), in a reader, where it was built with GDCM: with `slices` the files
/// of a series, else one with one frame or many. Space is LPS.
std::unique_ptr<VolumeFile> open_dicom(const std::filesystem::path& path,
                                       const ReadOptions& options);

/// The files and times of a ParaView collection (.pvd), in its order, paths made relative to where
/// the program runs; in a reader. @throws Error naming the file
std::vector<std::pair<std::filesystem::path, double>> read_pvd(const std::filesystem::path& path);

} // namespace isochron::index
