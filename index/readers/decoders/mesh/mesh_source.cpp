// Sets up vtkExodusIIReader, vtkCGNSReader, vtkOpenFOAMReader, vtkAMReXGridReader and
// vtkGenericEnSightReader.
#include "index/readers/decoders/mesh/mesh_source.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/readers/decoders/mesh/mesh_fields.h"
#include "index/readers/formats/data_stream.h"

#include <vtkAMReXGridReader.h>
#include <vtkCGNSReader.h>
#include <vtkDataArraySelection.h>
#include <vtkDummyController.h>
#include <vtkExodusIIReader.h>
#include <vtkGenericEnSightReader.h>
#include <vtkNew.h>
#include <vtkPOpenFOAMReader.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

MeshSource exodus_source(const fs::path& path) {
    // Exodus files are NetCDF, classic or on HDF5. VTK would ask any other file for its sizes, too.
    const std::string head = head_of(path, 8);
    if (!head.starts_with("CDF") && !head.starts_with("\x89HDF"))
        throw Error("{}: not Exodus: expected NetCDF", path.string());
    const vtkNew<vtkExodusIIReader> reader;
    reader->SetFileName(path.c_str());
    reader->ApplyDisplacementsOff();
    reader->GenerateObjectIdCellArrayOff();
    reader->GenerateGlobalElementIdArrayOff();
    reader->GenerateGlobalNodeIdArrayOff();
    const auto select = [raw = reader.GetPointer()] {
        raw->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
        raw->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
    };
    return {reader.GetPointer(),
            select,
            "",
            "",
            {"nodes are where they are at rest: displacements are arrays like others"},
            [raw = reader.GetPointer()] { return unread_of_exodus(*raw); }};
}

MeshSource cgns_source(const fs::path& path) {
    const vtkNew<vtkCGNSReader> reader;
    reader->SetFileName(path.c_str());
    const auto select = [raw = reader.GetPointer()] {
        raw->EnableAllBases();
        raw->EnableAllFamilies();
        raw->EnableAllPointArrays();
        raw->EnableAllCellArrays();
    };
    return {reader.GetPointer(), select, "", "", {}, [path] { return unread_of_cgns(path); }};
}

/// The last time of a case, whose times are folders; below all numbers if there is none.
double last_time_in(const fs::path& folder) {
    double last = -std::numeric_limits<double>::infinity();
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        const char* const end = name.data() + name.size();
        double time = 0;
        if (const auto read = std::from_chars(name.data(), end, time);
            read.ec == std::errc() && read.ptr == end)
            last = std::max(last, time);
    }
    return last;
}

/// Whether the results lie in a folder for each processor.
bool is_divided(const fs::path& folder) {
    std::error_code ignored;
    return fs::exists(folder / "processor0/constant/polyMesh", ignored) &&
           (!fs::exists(folder / "constant/polyMesh", ignored) ||
            last_time_in(folder / "processor0") > last_time_in(folder));
}

/// Whether the results of all processors lie in one folder: VTK's reader does not know this form.
bool is_collated(const fs::path& folder) {
    std::error_code ignored;
    return std::ranges::any_of(fs::directory_iterator(folder, ignored), [](const auto& entry) {
        return entry.path().filename().string().starts_with("processors");
    });
}

/// @param path of a .foam in the case's folder, or of its system/controlDict
MeshSource openfoam_source(const fs::path& path) {
    std::error_code ignored;
    const fs::path within = fs::absolute(path, ignored).parent_path();
    const fs::path folder = path.extension() == ".foam" ? within : within.parent_path();
    const bool divided = is_divided(folder);
    for (const char* needed : {"system/controlDict", "constant/polyMesh"})
        if (!fs::exists(folder / needed, ignored) &&
            !(divided && needed == std::string_view("constant/polyMesh")))
            throw Error("{}: an OpenFOAM case without {}{}", path.string(), needed,
                        is_collated(folder)
                            ? ": its processors share a folder, reconstructPar puts it together"
                            : "");
    const vtkNew<vtkPOpenFOAMReader> reader;
    reader->SetController(vtkNew<vtkDummyController>()); // without one it crashes on parts
    reader->SetCaseType(divided ? vtkPOpenFOAMReader::DECOMPOSED_CASE
                                : vtkPOpenFOAMReader::RECONSTRUCTED_CASE);
    reader->SetFileName((folder / "system" / "controlDict").c_str());
    reader->CreateCellToPointOn();
    reader->CacheMeshOn();
    const auto select = [raw = reader.GetPointer()] {
        raw->DisableAllPatchArrays();
        raw->SetPatchArrayStatus("internalMesh", 1);
        raw->DisableAllLagrangianArrays();
        raw->EnableAllCellArrays();
        raw->EnableAllPointArrays();
    };
    MeshSource source{
        reader.GetPointer(),
        select,
        "m",
        "s",
        {"values of cells are averaged to points by VTK before they are interpolated"}};
    source.unit_of = [cases = std::vector{folder, folder / "processor0"}](
                         const std::string& field) { return unit_of_openfoam(cases, field); };
    if (divided)
        source.notes.push_back("the case is divided among processors: where their parts meet, "
                               "points have the mean of the cells of one part");
    return source;
}

MeshSource amrex_source(const fs::path& path) {
    constexpr int kEveryLevel = 64;
    if (const std::int64_t dimensions = dimensions_of_amrex(path); dimensions != 3)
        throw Error("{}: a plotfile of {} dimensions, expected 3", path.string(), dimensions);
    const vtkNew<vtkAMReXGridReader> reader;
    reader->SetFileName(path.parent_path().c_str());
    const auto select = [raw = reader.GetPointer()] {
        raw->SetMaxLevel(kEveryLevel);
        raw->GetCellDataArraySelection()->EnableAllArrays();
        raw->GetPointDataArraySelection()->EnableAllArrays();
    };
    return {reader.GetPointer(), select, "", "", {}, [path] { return unread_of_amrex(path); }};
}

/// EnSight Gold and 6, as text and binary.
MeshSource ensight_source(const fs::path& path) {
    const vtkNew<vtkGenericEnSightReader> reader;
    reader->SetCaseFileName(path.c_str());
    reader->ReadAllVariablesOn();
    return {reader.GetPointer(), [] {}, "", "", {}};
}

} // namespace

MeshSource open_mesh_source(const fs::path& path) {
    const std::string extension = lower_case(path.extension().string());
    const std::string name = path.filename().string();
    if (extension == ".cgns")
        return cgns_source(path);
    if (extension == ".foam" || name == "controlDict")
        return openfoam_source(path);
    if (name == "Header")
        return amrex_source(path);
    if (extension == ".case")
        return ensight_source(path);
    return exodus_source(path);
}

} // namespace isochron::index
