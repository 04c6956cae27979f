// VTK's reader for a mesh file, set up to give all that it holds.
#pragma once

#include <vtkAlgorithm.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace isochron::index {

struct MeshSource {
    vtkSmartPointer<vtkAlgorithm> reader;
    /// Selects all arrays; the reader knows them once its information has been updated.
    std::function<void()> select_all;
    std::string length_unit, time_unit; ///< units that the format sets; empty if none
    std::vector<std::string> notes;
    /// What the file states and nobody reads, as `note_on_unread` takes it; once the reader's
    /// information has been updated.
    std::function<std::vector<std::string>()> unread = [] { return std::vector<std::string>(); };
    /// The unit of an array; empty where the format has none.
    std::function<std::string(const std::string& array)> unit_of = [](const std::string&) {
        return std::string();
    };
};

/// The reader for an Exodus (.e, .exo, .ex2, .exii) or CGNS file, an OpenFOAM case (.foam,
/// controlDict), an AMReX plotfile (Header) or an EnSight case (.case). Reads only what is needed to tell them apart.
/// @throws Error naming the file, when it is none of these
MeshSource open_mesh_source(const std::filesystem::path& path);

} // namespace isochron::index
