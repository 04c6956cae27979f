// Stands before the function of LLVM with which a driver asks for what it compiled.
#include "tests/support/drawing/compilations.h"

#include <dlfcn.h>
#include <link.h>

#include <atomic>
#include <string_view>

namespace {

std::atomic<int> compiled{0};

using Compile = void* (*)(void* engine, void* function);

/// The library was loaded with a driver, so that `RTLD_NEXT` does not find it.
Compile of_llvm() {
    void* library = nullptr;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* found) {
            if (std::string_view(info->dlpi_name).find("libLLVM") == std::string_view::npos)
                return 0;
            *static_cast<void**>(found) = dlopen(info->dlpi_name, RTLD_NOLOAD | RTLD_NOW);
            return 1;
        },
        &library);
    return library ? reinterpret_cast<Compile>(dlsym(library, "LLVMGetPointerToGlobal")) : nullptr;
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): LLVM's name
extern "C" __attribute__((visibility("default"))) void* LLVMGetPointerToGlobal(void* engine,
                                                                               void* function) {
    static const Compile kCompile = of_llvm();
    ++compiled;
    return kCompile(engine, function);
}

namespace isochron::test_support {

int compilations() {
    return compiled;
}

} // namespace isochron::test_support
