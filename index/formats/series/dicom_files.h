// DICOM files, which have any name, and folders of them.
#pragma once

#include <filesystem>
#include <vector>

namespace isochron::index {

/// Whether a file is DICOM: by its extension (.dcm, .dicom, .ima), or by the letters `DICM` after
/// its first 128 bytes.
bool is_dicom(const std::filesystem::path& path);

/// Replaces each folder by the DICOM files in it and in its subfolders. Folders without DICOM files
/// stay in the list. @throws Error naming a folder with more than a million files
std::vector<std::filesystem::path>
with_dicom_folders(const std::vector<std::filesystem::path>& files);

} // namespace isochron::index
