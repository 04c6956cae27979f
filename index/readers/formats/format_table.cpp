// The table of formats: a new one is a row here, and the source that opens or decodes it.
#include "index/lower_case.h"
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/format.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/series/dicom_series.h"
#include "index/readers/formats/series/json_series.h"
#include "index/readers/formats/series/slice_files.h"

#include <algorithm>
#include <array>

namespace isochron::index {
namespace {

using namespace std::string_view_literals;

/// The signature may stand behind a block of another program, such as MATLAB's.
bool is_hdf5(FileStart& start) {
    constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
    constexpr std::array<std::size_t, 4> kPlaces{0, 512, 1024, 2048};
    return std::ranges::any_of(kPlaces, [&](std::size_t place) {
        const std::string_view bytes = start.bytes(place + kSignature.size());
        return bytes.size() > place && bytes.substr(place) == kSignature;
    });
}

/// NetCDF-4 is HDF5 whose attributes have these names.
bool is_netcdf4(FileStart& start) {
    if (!is_hdf5(start))
        return false;
    constexpr std::size_t kLooked = 1 << 16;
    const std::string_view bytes = start.bytes(kLooked);
    for (const char* name : {"_NCProperties", "_Netcdf4Dimid", "_Netcdf4Coordinates",
                             "This is a netCDF dimension but not a netCDF variable"})
        if (bytes.find(name) != bytes.npos)
            return true;
    return false;
}

bool is_netcdf(FileStart& start) {
    const std::string_view bytes = start.bytes(4);
    return bytes == "CDF\x01" || bytes == "CDF\x02" || bytes == "CDF\x05" || is_netcdf4(start);
}

/// Notes and logs end like Exodus, too, so that content decides.
bool is_netcdf_or_hdf5(FileStart& start) {
    return is_hdf5(start) || is_netcdf(start);
}

/// NIfTI-1 and -2 in one file; not a pair, whose values have any first bytes.
bool is_nifti(FileStart& start) {
    constexpr std::size_t kMagic1 = 344;
    const std::string_view bytes = start.bytes(kMagic1 + 4);
    return (bytes.size() > kMagic1 && bytes.substr(kMagic1) == std::string_view("n+1", 4)) ||
           bytes.substr(std::min<std::size_t>(bytes.size(), 4)).starts_with("n+2\0\r\n\x1a\n"sv);
}

bool is_compressed(FileStart& start) {
    return start.bytes(2) == "\x1f\x8b"sv;
}

/// Whether it is NIfTI or the values of a pair.
bool may_be_nifti(FileStart& start) {
    return is_nifti(start) || is_compressed(start) || has_nifti_header_beside(start.path());
}

bool is_tiff_or_dual(FileStart& start) {
    const std::string_view bytes = start.bytes(4);
    return bytes == "II*\0"sv || bytes == "MM\0*"sv || bytes == "II+\0"sv || bytes == "MM\0+"sv;
}

/// The type of data in VTK XML: `ImageData`; empty: no VTK XML.
std::string_view type_in_vtk_xml(FileStart& start) {
    constexpr std::size_t kLooked = 512;
    const std::string_view bytes = start.bytes(kLooked);
    const std::size_t tag = bytes.starts_with('<') ? bytes.find("<VTKFile") : bytes.npos;
    const std::size_t type = tag == bytes.npos ? tag : bytes.find("type=", tag);
    const std::size_t begin = type == bytes.npos ? type : bytes.find_first_of("\"'", type);
    if (begin == bytes.npos)
        return {};
    const std::string_view rest = bytes.substr(begin + 1);
    return rest.substr(0, rest.find(bytes[begin]));
}

bool is_vti(FileStart& start) {
    return type_in_vtk_xml(start) == "ImageData";
}

bool is_pvd(FileStart& start) {
    return type_in_vtk_xml(start) == "Collection";
}

/// What a volume can be made of: no surfaces, no tables.
bool is_vtk_data(FileStart& start) {
    constexpr std::array kTypes{
        "PImageData"sv,           "RectilinearGrid"sv,          "PRectilinearGrid"sv,
        "StructuredGrid"sv,       "PStructuredGrid"sv,          "UnstructuredGrid"sv,
        "PUnstructuredGrid"sv,    "vtkMultiBlockDataSet"sv,     "vtkOverlappingAMR"sv,
        "vtkNonOverlappingAMR"sv, "vtkHierarchicalBoxDataSet"sv};
    return std::ranges::find(kTypes, type_in_vtk_xml(start)) != kTypes.end();
}

bool is_vtk_xml(FileStart& start) {
    return !type_in_vtk_xml(start).empty();
}

bool is_xdmf(FileStart& start) {
    constexpr std::size_t kLooked = 512;
    const std::string_view bytes = start.bytes(kLooked);
    return bytes.starts_with('<') && bytes.find("<Xdmf") != bytes.npos;
}

bool is_plain_hdf5(FileStart& start) {
    return is_hdf5(start) && !is_netcdf4(start);
}

bool is_nrrd(FileStart& start) {
    return start.bytes(7) == "NRRD000";
}

bool is_legacy_vtk(FileStart& start) {
    constexpr std::string_view kBegin = "# vtk DataFile";
    return start.bytes(kBegin.size()) == kBegin;
}

/// The letters after the preamble.
bool is_dicom(FileStart& start) {
    constexpr std::size_t kPreamble = 128;
    const std::string_view bytes = start.bytes(kPreamble + 4);
    return bytes.size() > kPreamble && bytes.substr(kPreamble) == "DICM";
}

constexpr std::size_t kMrcHeader = 1024;

/// MRC of 2000 and later.
bool is_named_mrc(FileStart& start) {
    const std::string head(start.bytes(kMrcHeader));
    return head.size() == kMrcHeader && head.compare(208, 3, "MAP") == 0 && is_mrc(head);
}

/// Other programs' files end like MRC, too, so that content decides.
bool is_any_mrc(FileStart& start) {
    return is_compressed(start) || is_mrc(std::string(start.bytes(kMrcHeader)));
}

bool is_tiff(FileStart& start) {
    return is_tiff_or_dual(start) && !is_dicom(start);
}

/// The first line of a plotfile's Header; older codes gave it their own names.
bool is_amrex_header(FileStart& start) {
    if (start.path().filename() != "Header")
        return false;
    const std::string_view bytes = start.bytes(64);
    return bytes.starts_with("HyperCLaw-V1") || bytes.starts_with("NavierStokes-V1") ||
           bytes.starts_with("CartGrid-V2");
}

/// The words behind FORMAT, in its first section.
bool is_ensight(FileStart& start) {
    constexpr std::size_t kLooked = 4096;
    const std::string head = lower_case(std::string(start.bytes(kLooked)));
    const std::size_t type = head.find("type:");
    return head.find("format") < type && head.find("ensight", type) < head.find('\n', type);
}

std::vector<Format> table() {
    return {
        // Lists of files.
        {.name = "pvd",
         .ends = {{".pvd"}},
         .recognize = is_pvd,
         .list = read_pvd,
         .lists_parts = true,
         .names_files = true},
        {.name = "json series",
         .ends = {{".series"}},
         .list = read_json_series,
         .names_files = true},

        // VTK's image data, XML and legacy.
        {.name = "vti", .ends = {{".vti"}}, .recognize = is_vti, .reader = "vti"},
        {.name = "vtk", .ends = {{".vtk"}}, .recognize = is_legacy_vtk, .reader = "vtk"},

        // Formats of medicine. MetaImage and NRRD may have their data beside them.
        {.name = "metaimage",
         .ends = {{".mhd"}, {".mha"}},
         .open = open_metaimage,
         .names_files = true},
        {.name = "nrrd",
         .ends = {{".nrrd"}, {".nhdr"}},
         .recognize = is_nrrd,
         .open = open_nrrd,
         .names_files = true},
        {.name = "nifti",
         .ends = {{".nii"},
                  {".nii.gz"},
                  {".hdr", {".img"}},
                  {".hdr.gz", {".img.gz"}},
                  {".img"},
                  {".img.gz"}},
         .recognize = is_nifti,
         .may_begin = may_be_nifti,
         .open = open_nifti},

        {.name = "netcdf",
         .ends = {{".nc"}, {".nc4"}, {".cdf"}},
         .recognize = is_netcdf,
         .may_begin = is_netcdf_or_hdf5,
         .reader = "netcdf",
         .reads_parts = true,
         .names_files = true},

        // VTK's rectilinear grids, files of several pieces, and, with `resample`, its other grids.
        {.name = "vtk data",
         .ends = {{".vtr"},
                  {".pvti", {".vti"}},
                  {".pvtr", {".vtr"}},
                  {".vtu"},
                  {".vts"},
                  {".pvtu", {".vtu"}},
                  {".pvts", {".vts"}},
                  {".vtm", {".vti", ".vtr", ".vtu", ".vts"}},
                  {".vth", {".vti"}},
                  {".vthb", {".vti"}}},
         .recognize = is_vtk_data,
         .may_begin = is_vtk_xml,
         .reader = "vtk",
         .decodes_all_arrays = true,
         .names_files = true},

        {.name = "tiff",
         .ends = {{".tif"}, {".tiff"}, {".btf"}, {".lsm"}, {".stk"}},
         .recognize = is_tiff,
         .may_begin = is_tiff_or_dual,
         .reader = "tiff",
         .join = tiff_series,
         .joins_by_names = true,
         .names_files = true},
        {.name = "hdf5",
         .ends = {{".h5"}, {".hdf5"}, {".he5"}, {".hdf"}, {".vtkhdf"}, {".athdf"}},
         .recognize = is_plain_hdf5,
         .may_begin = is_hdf5,
         .reader = "hdf5",
         .reads_parts = true,
         .names_files = true},
        {.name = "zarr",
         .ends = {{"zarr.json"}, {".zattrs"}, {".zarray"}, {".zgroup"}, {".zip"}, {".ozx"}},
         .reader = "zarr",
         .reads_parts = true,
         .describe_folder = {"zarr.json", ".zattrs", ".zarray", ".zgroup"},
         .folder_ends = {".zarr"}},
        {.name = "raw", .ends = {{".raw"}}, .open = open_raw, .headerless = true},
        {.name = "dicom",
         .ends = {{".dcm"}, {".dicom"}, {".ima"}},
         .recognize = is_dicom,
         .reader = "dicom",
         .join = dicom_series},

        // Meshes of simulations, which must be resampled: CGNS, Exodus, OpenFOAM, AMReX, EnSight.
        {.name = "mesh",
         .ends = {{".cgns"},
                  {".exo"},
                  {".ex2"},
                  {".exii"},
                  {".e", {}, is_netcdf_or_hdf5},
                  {".case", {}, is_ensight},
                  {.end = ".foam", .with_folder = true},
                  {"controldict"}},
         .recognize = is_amrex_header,
         .may_begin = is_netcdf_or_hdf5,
         .reader = "mesh",
         .decodes_all_arrays = true,
         .names_files = true,
         .describe_folder = {"system/controlDict", "Header"}},

        // Maps and tomograms of electron microscopes, which FreeSurfer's and Gaussian's follow.
        {.name = "mrc",
         .ends = {{".mrc"},
                  {".mrcs"},
                  {".ccp4"},
                  {".map", {}, is_any_mrc},
                  {".rec", {}, is_any_mrc},
                  {".st", {}, is_any_mrc},
                  {".ali", {}, is_any_mrc},
                  {".mrc.gz"},
                  {".map.gz"}},
         .recognize = is_named_mrc,
         .may_begin = is_any_mrc,
         .open = open_mrc},
        {.name = "mgh",
         .ends = {{".mgh"}, {".mgz"}, {".mgh.gz"}},
         .may_begin = is_compressed,
         .open = open_mgh},
        {.name = "gaussian cube", .ends = {{".cube"}, {".cub"}}, .open = open_gaussian_cube},

        {.name = "bov", .ends = {{".bov"}}, .open = open_bov, .names_files = true},
        {.name = "xdmf",
         .ends = {{".xmf", {".h5", ".hdf5", ".hdf", ".raw"}},
                  {".xdmf", {".h5", ".hdf5", ".hdf", ".raw"}}},
         .recognize = is_xdmf,
         .reader = "hdf5",
         .names_files = true},
    };
}

} // namespace

const std::vector<Format>& all_formats() {
    static const std::vector<Format> kFormats = table();
    return kFormats;
}

} // namespace isochron::index
