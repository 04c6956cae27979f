// Names and patterns of input files, as a user gives them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Names stay as they are, quoted patterns (`'t*.vti'`) become the files they match. Brackets of folders
/// and files that are there (`'run[1]/t*.vti'`) stand for themselves.
/// @throws index::Error for a pattern that matches nothing
std::vector<std::filesystem::path> expand_patterns(const std::vector<std::string>& arguments);

/// Splits the path of an array off a file's name: `run.h5:/fields/rho` is the array `/fields/rho`
/// of run.h5. An argument that is the whole name of an existing file is left alone.
/// @return the path, if any argument has one @throws index::Error when they name different ones
std::optional<std::string> take_path_within(std::vector<std::string>& arguments);

} // namespace isochron::app
