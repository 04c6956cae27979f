// The program's own modules and programs: heavy libraries stay out of its start.
#pragma once

#include <filesystem>
#include <string>

namespace isochron::index {

/// A file of ours, `isochron-reader-vtk` or `libisochron_mpi.so`: beside the program, where a build
/// puts it, or in ../libexec/isochron, where it is installed. Nowhere else is looked.
/// @throws Error naming the file and the folder of the program
std::filesystem::path file_of_program(const std::string& name);

/// Address of `symbol` in `lib<name>.so`. The module stays loaded.
/// @throws Error naming the module and what the loader said
void* module_symbol(const std::string& name, const std::string& symbol);

} // namespace isochron::index
