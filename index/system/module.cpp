// Finds the program's own files, and loads its modules.
#include "index/system/module.h"

#include "index/error.h"

#include <fmt/format.h>

#include <dlfcn.h>

#include <array>
#include <mutex>
#include <string_view>

namespace isochron::index {

namespace fs = std::filesystem;

namespace {

/// Where the program's files are; empty: beside the running program. Readers are started by several
/// threads.
struct ProgramFolder {
    std::mutex mutex;
    fs::path folder;
};

/// Files that packages of their own bring, and that `./run build --everything` builds.
struct Component {
    std::string_view file, package;
};
constexpr std::array kComponents{Component{"isochron-reader-vtk", "isochron-readers-vtk"},
                                 Component{"isochron-reader-mesh", "isochron-readers-vtk"},
                                 Component{"libisochron_mpi.so", "isochron-mpi"},
                                 Component{"isochron-generate", "isochron-generate"}};
/// Files that are built where these packages are.
constexpr std::array kBuiltWith{Component{"libisochron_links.so", "libcurl4-gnutls-dev"},
                                Component{"libisochron_pages.so", "libcairo2-dev"},
                                Component{"libisochron_site.so", "libmicrohttpd-dev"}};

ProgramFolder& folder_that_was_set() {
    static ProgramFolder folder;
    return folder;
}

} // namespace

void set_program_folder(const fs::path& folder) {
    ProgramFolder& set = folder_that_was_set();
    const std::lock_guard lock(set.mutex);
    set.folder = folder.empty() ? folder : fs::absolute(folder);
}

fs::path program_folder() {
    ProgramFolder& set = folder_that_was_set();
    const std::lock_guard lock(set.mutex);
    return set.folder.empty() ? fs::read_symlink("/proc/self/exe").parent_path() : set.folder;
}

fs::path file_of_program(const std::string& name) {
    const fs::path folder = program_folder();
    for (const fs::path& place :
         std::array{folder / name, folder.parent_path() / "libexec" / "isochron" / name})
        if (fs::exists(place))
            return place;
    std::string way_out;
    for (const auto& [file, package] : kComponents)
        if (file == name)
            way_out =
                fmt::format("; `apt install {}` brings it, or `./run build --everything` where "
                            "the program was built",
                            package);
    for (const auto& [file, package] : kBuiltWith)
        if (file == name)
            way_out = fmt::format(
                "; `apt install {}` and `./run build` where the program was built bring it",
                package);
    throw Error("{}: not found beside the program in {}{}", name, folder.string(), way_out);
}

void* module_symbol(const std::string& name, const std::string& symbol) {
    const fs::path place = file_of_program("lib" + name + ".so");
    void* handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle)
        throw Error("{}: cannot be loaded: {}", place.string(), dlerror());
    if (void* address = dlsym(handle, symbol.c_str()))
        return address;
    throw Error("{}: has no {}", place.string(), symbol);
}

} // namespace isochron::index
