// What meshes of simulations state besides their cells and arrays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

class vtkExodusIIReader;

namespace isochron::index {

/// The functions with `unread` give fields as `note_on_unread` takes them.
std::vector<std::string> unread_of_exodus(vtkExodusIIReader& reader);
std::vector<std::string> unread_of_cgns(const std::filesystem::path& path);
/// @param path of the plotfile's Header
std::int64_t dimensions_of_amrex(const std::filesystem::path& path);
/// @param path of the plotfile's Header
std::vector<std::string> unread_of_amrex(const std::filesystem::path& path);

/// The unit that OpenFOAM's `dimensions` of a field give, `kg m-1 s-2`; empty where there is none.
/// @param cases folders that hold the folders of times
std::string unit_of_openfoam(const std::vector<std::filesystem::path>& cases,
                             const std::string& field);

} // namespace isochron::index
