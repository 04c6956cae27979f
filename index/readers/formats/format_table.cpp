// The table of formats: a new one is a row here, and the source that opens or decodes it.
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/format.h"
#include "index/readers/formats/own_formats.h"
#include "index/readers/formats/series/dicom_series.h"
#include "index/readers/formats/series/json_series.h"
#include "index/readers/formats/series/slice_files.h"

namespace isochron::index {
namespace {

bool is_hdf5(FileStart& start) {
    constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
    return start.bytes(kSignature.size()) == kSignature;
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

/// The first line of a plotfile's Header; older codes gave it their own names.
bool is_amrex_header(FileStart& start) {
    if (start.path().filename() != "Header")
        return false;
    const std::string_view bytes = start.bytes(64);
    return bytes.starts_with("HyperCLaw-V1") || bytes.starts_with("NavierStokes-V1") ||
           bytes.starts_with("CartGrid-V2");
}

std::vector<Format> table() {
    return {
        // Lists of files.
        {.name = "pvd",
         .ends = {{".pvd"}},
         .list = read_pvd,
         .lists_parts = true,
         .names_files = true},
        {.name = "json series",
         .ends = {{".series"}},
         .list = read_json_series,
         .names_files = true},

        // VTK's image data, XML and legacy.
        {.name = "vti", .ends = {{".vti"}}, .reader = "vtk"},
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
         .open = open_nifti},

        {.name = "netcdf",
         .ends = {{".nc"}, {".nc4"}, {".cdf"}},
         .recognize = is_netcdf,
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
         .reader = "vtk",
         .decodes_all_arrays = true,
         .names_files = true},

        {.name = "tiff",
         .ends = {{".tif"}, {".tiff"}, {".btf"}},
         .reader = "tiff",
         .join = tiff_series,
         .joins_by_names = true,
         .names_files = true},
        {.name = "hdf5",
         .ends = {{".h5"}, {".hdf5"}, {".he5"}, {".hdf"}, {".vtkhdf"}},
         .recognize = is_plain_hdf5,
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

        // Meshes of simulations, which must be resampled: CGNS, Exodus, OpenFOAM, AMReX.
        {.name = "mesh",
         .ends = {{".cgns"},
                  {".exo"},
                  {".ex2"},
                  {".exii"},
                  {".e", {}, is_netcdf_or_hdf5},
                  {.end = ".foam", .with_folder = true},
                  {"controldict"}},
         .recognize = is_amrex_header,
         .reader = "mesh",
         .decodes_all_arrays = true,
         .names_files = true,
         .describe_folder = {"system/controlDict", "Header"}},

        {.name = "bov", .ends = {{".bov"}}, .open = open_bov, .names_files = true},
        {.name = "xdmf",
         .ends = {{".xmf", {".h5", ".hdf5", ".hdf", ".raw"}},
                  {".xdmf", {".h5", ".hdf5", ".hdf", ".raw"}}},
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
