// The formats whose libraries are heavy: from modules that are loaded when the first such file is
// opened.
#include "index/error.h"
#include "index/formats/readers.h"
#include "index/system/module.h"

#include <fmt/format.h>

namespace isochron::index {
namespace {

template <class Function>
Function from_module(const char* symbol, const char* module = "isochron_readers") {
    return reinterpret_cast<Function>(module_symbol(module, symbol));
}

using OpenInModule = VolumeFile* (*)(const std::filesystem::path&, const ReadOptions&);
using PvdFiles = std::vector<std::pair<std::filesystem::path, double>>;

} // namespace

std::unique_ptr<VolumeFile> open_vti(const std::filesystem::path& path,
                                     const ReadOptions& options) {
    static const auto open = from_module<OpenInModule>("isochron_open_vti");
    return std::unique_ptr<VolumeFile>(open(path, options));
}

std::unique_ptr<VolumeFile> open_vtk(const std::filesystem::path& path,
                                     const ReadOptions& options) {
    static const auto open = from_module<OpenInModule>("isochron_open_vtk");
    return std::unique_ptr<VolumeFile>(open(path, options));
}

std::unique_ptr<VolumeFile> open_netcdf(const std::filesystem::path& path,
                                        const ReadOptions& options) {
    static const auto open = [&] {
        try {
            return from_module<OpenInModule>("isochron_open_netcdf", "isochron_netcdf");
        } catch (const Error& error) {
            throw Error(fmt::format("{}: this program has no NetCDF (it was built without "
                                    "libnetcdf-dev?): {}",
                                    path.string(), error.what()));
        }
    }();
    return std::unique_ptr<VolumeFile>(open(path, options));
}

PvdFiles read_pvd(const std::filesystem::path& path) {
    static const auto read =
        from_module<void (*)(const std::filesystem::path&, PvdFiles&)>("isochron_read_pvd");
    PvdFiles files;
    read(path, files);
    return files;
}

} // namespace isochron::index
