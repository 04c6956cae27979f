// Finds the program's own modules and helper programs, in which heavy libraries are loaded when
// they are needed.
#pragma once

#include <filesystem>
#include <string>

namespace isochron::index {

/// The path of one of the program's files, `isochron-reader-vtk` or `libisochron_mpi.so`: beside
/// the program (in a build folder) or in ../libexec/isochron (installed), and nowhere else.
/// @throws Error naming the file and the folder of the program
std::filesystem::path file_of_program(const std::string& name);

/// Address of `symbol` in `lib<name>.so`. The module stays loaded.
/// @throws Error naming the module, with the loader's message
void* module_symbol(const std::string& name, const std::string& symbol);

} // namespace isochron::index
