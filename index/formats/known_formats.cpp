// The table of formats.
#include "index/formats/known_formats.h"

#include "index/error.h"
#include "index/formats/readers.h"
#include "index/formats/text_header.h"
#include "index/lower_case.h"
#include "index/system/input_file.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

struct Format {
    std::string_view extension;
    OpenFormat open;
};

/// One entry for each extension; the first that matches the end of a name is used.
constexpr std::array kFormats{
    Format{".vti", open_vti},         Format{".vtk", open_vtk},
    Format{".mhd", open_metaimage},   Format{".mha", open_metaimage},
    Format{".nrrd", open_nrrd},       Format{".nhdr", open_nrrd},
    Format{".nii", open_nifti},       Format{".nii.gz", open_nifti},
    Format{".hdr", open_nifti},       Format{".hdr.gz", open_nifti},
    Format{".img", open_nifti},       Format{".img.gz", open_nifti},
    Format{".nc", open_netcdf},       Format{".nc4", open_netcdf},
    Format{".cdf", open_netcdf},      Format{".vtr", open_vtk_data},
    Format{".pvti", open_vtk_data},   Format{".pvtr", open_vtk_data},
    Format{".vtu", open_vtk_data},    Format{".vts", open_vtk_data},
    Format{".pvtu", open_vtk_data},   Format{".pvts", open_vtk_data},
    Format{".vtm", open_vtk_data},    Format{".vth", open_vtk_data},
    Format{".tif", open_tiff},        Format{".tiff", open_tiff},
    Format{".btf", open_tiff},        Format{".h5", open_hdf5},
    Format{".hdf5", open_hdf5},       Format{".he5", open_hdf5},
    Format{"zarr.json", open_zarr},   Format{".zattrs", open_zarr},
    Format{".zarray", open_zarr},     Format{".zgroup", open_zarr},
    Format{".zip", open_zarr},        Format{".ozx", open_zarr},
    Format{".hdf", open_hdf5},        Format{".vtkhdf", open_hdf5},
    Format{".raw", open_raw},         Format{".dcm", open_dicom},
    Format{".dicom", open_dicom},     Format{".ima", open_dicom},
    Format{".cgns", open_mesh},       Format{".exo", open_mesh},
    Format{".ex2", open_mesh},        Format{".exii", open_mesh},
    Format{".e", open_mesh},          Format{".foam", open_mesh},
    Format{"controldict", open_mesh}, Format{".bov", open_bov},
    Format{".xmf", open_xdmf},        Format{".xdmf", open_xdmf},
};

/// NetCDF-4 is HDF5 whose attributes have these names.
bool holds_netcdf_names(std::string_view bytes) {
    for (const char* name : {"_NCProperties", "_Netcdf4Dimid", "_Netcdf4Coordinates",
                             "This is a netCDF dimension but not a netCDF variable"})
        if (bytes.find(name) != bytes.npos)
            return true;
    return false;
}

/// The first line of a plotfile's Header; older codes gave it their own names.
bool is_amrex_header(const fs::path& path, std::string_view begin) {
    return path.filename() == "Header" &&
           (begin.starts_with("HyperCLaw-V1") || begin.starts_with("NavierStokes-V1") ||
            begin.starts_with("CartGrid-V2"));
}

OpenFormat format_of_content(const fs::path& path) {
    constexpr std::size_t kLooked = 1 << 16;
    std::string begin(kLooked, '\0');
    try {
        const InputFile file(path);
        begin.resize(file.read(0, std::as_writable_bytes(std::span(begin))));
    } catch (const Error&) { // a folder, or nothing that can be read
        return nullptr;
    }
    if (begin.starts_with("\x89HDF\r\n\x1a\n"))
        return holds_netcdf_names(begin) ? open_netcdf : open_hdf5;
    if (begin.starts_with("CDF\x01") || begin.starts_with("CDF\x02") ||
        begin.starts_with("CDF\x05"))
        return open_netcdf;
    if (begin.starts_with("NRRD000"))
        return open_nrrd;
    if (is_amrex_header(path, begin))
        return open_mesh;
    return begin.starts_with("# vtk DataFile") ? open_vtk : nullptr;
}

/// Notes and logs end like this, too, so that content decides.
constexpr std::string_view kExodusOrText = ".e";

bool holds_netcdf(const fs::path& path) {
    const OpenFormat format = format_of_content(path);
    return format == open_netcdf || format == open_hdf5;
}

} // namespace

OpenFormat format_of(const fs::path& path) {
    const std::string name = lower_case(path.filename().string());
    for (const Format& format : kFormats)
        if (name.ends_with(format.extension) &&
            (format.extension != kExodusOrText || holds_netcdf(path)))
            return format.open;
    return format_of_content(path);
}

bool lists_files(const fs::path& path) {
    const std::string extension = lower_case(path.extension().string());
    return extension == ".pvd" || extension == ".series";
}

fs::path described_in(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored))
        return path;
    for (const char* name : {"zarr.json", ".zattrs", ".zarray", ".zgroup", "system/controlDict"})
        if (fs::is_regular_file(path / name, ignored))
            return path / name;
    const fs::path header = path / "Header";
    return format_of_content(header) == open_mesh ? header : path;
}

std::string known_extensions() {
    std::string known = ".pvd .series";
    for (const Format& format : kFormats)
        known += fmt::format(" {}", format.extension);
    return known;
}

} // namespace isochron::index
