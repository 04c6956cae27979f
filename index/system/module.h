// Finds the program's own modules and helper programs: they load heavy libraries when these are
// needed.
#pragma once

#include <filesystem>
#include <string>

namespace isochron::index {

/// Sets the program's folder: for interpreters and other programs that only host this library, as
/// their own folders have none of its files. Called before the first file is needed.
/// @param folder empty: the folder of the running program again
void set_program_folder(const std::filesystem::path& folder);

/// The folder that was set, or else the folder of the running program.
std::filesystem::path program_folder();

/// The path of one of the program's files, `isochron-reader-vtk` or `libisochron_mpi.so`: in the
/// program's folder (as in a build) or in ../libexec/isochron beside it (installed), and nowhere
/// else. @throws Error naming the file and the program's folder
std::filesystem::path file_of_program(const std::string& name);

/// Address of `symbol` in `lib<name>.so`. The module stays loaded.
/// @throws Error naming the module, with the loader's message
void* module_symbol(const std::string& name, const std::string& symbol);

} // namespace isochron::index
