// Names and patterns of input files, as a user gives them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Names stay as they are, quoted patterns (`'t*.vti'`) become the files they match.
/// @throws index::Error for a pattern that matches nothing
std::vector<std::filesystem::path> expand_patterns(const std::vector<std::string>& arguments);

/// Takes the path within a file off its name: `run.h5:/fields/rho` is the array `/fields/rho` of
/// run.h5. What exists under its whole name is left alone.
/// @return the path, if any has one @throws index::Error when names give several
std::optional<std::string> take_path_within(std::vector<std::string>& arguments);

/// @throws index::Error when `out` is one of `files`: writing it would destroy what is read
void refuse_input_as_output(const std::vector<std::filesystem::path>& files,
                            const std::filesystem::path& out);

} // namespace isochron::app
