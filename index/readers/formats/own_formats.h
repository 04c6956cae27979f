// The formats that need no library: one function for each, in a separate file.
#pragma once

#include "index/readers/formats/volume_file.h"

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

/// NIfTI-1 and -2, and Analyze 7.5: .nii, .nii.gz, .hdr with .img; either file names the pair.
/// The fourth axis is time. Space is RAS.
std::unique_ptr<VolumeFile> open_nifti(const std::filesystem::path& path,
                                       const ReadOptions& options);

/// Whether a file is the `.img` of a pair, and its `.hdr` beside it.
bool has_nifti_header_beside(const std::filesystem::path& path);

/// Whether the first 1,024 bytes may be the header of an MRC file.
bool is_mrc(const std::string& head);

/// MRC and CCP4 maps, tomograms and stacks (.mrc, .map, .rec): either byte order, axes in any order.
std::unique_ptr<VolumeFile> open_mrc(const std::filesystem::path& path, const ReadOptions& options);

/// FreeSurfer's .mgh and .mgz. Space is RAS.
std::unique_ptr<VolumeFile> open_mgh(const std::filesystem::path& path, const ReadOptions& options);

/// Gaussian's cubes of values: axes slowest first, in bohr or angstrom; several values a point are
/// components.
std::unique_ptr<VolumeFile> open_gaussian_cube(const std::filesystem::path& path,
                                               const ReadOptions& options);

} // namespace isochron::index
