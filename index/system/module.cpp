// Loading of the program's own modules on demand.
#include "index/system/module.h"

#include "index/error.h"

#include <fmt/format.h>

#include <dlfcn.h>

#include <array>
#include <filesystem>

namespace isochron::index {

void* module_symbol(const std::string& name, const std::string& symbol) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
    const std::string file = "lib" + name + ".so";
    // Test programs lie one folder below the program in the build tree.
    const std::array places{folder / file, folder.parent_path() / file,
                            folder.parent_path() / "lib" / "isochron" / file};
    for (const fs::path& place : places) {
        if (!fs::exists(place))
            continue;
        void* handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!handle)
            throw Error(fmt::format("{}: cannot be loaded: {}", place.string(), dlerror()));
        if (void* address = dlsym(handle, symbol.c_str()))
            return address;
        throw Error(fmt::format("{}: has no {}", place.string(), symbol));
    }
    throw Error(fmt::format("{}: not found beside the program in {}", file, folder.string()));
}

} // namespace isochron::index
