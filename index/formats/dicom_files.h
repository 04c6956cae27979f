// DICOM files, which have any name, and folders of them.
#pragma once

#include <filesystem>
#include <vector>

namespace isochron::index {

/// By its extension (.dcm, .dicom, .ima), or by the letters that DICOM files have behind their
/// first 128 bytes.
bool is_dicom(const std::filesystem::path& path);

/// Puts the DICOM files in a folder, and in the folders within it, in its place. Folders without
/// any stay. @throws Error naming a folder with more than a million files
std::vector<std::filesystem::path>
with_dicom_folders(const std::vector<std::filesystem::path>& files);

} // namespace isochron::index
