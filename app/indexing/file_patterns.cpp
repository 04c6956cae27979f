// Names and patterns of input files, as a user gives them.
#include "app/indexing/file_patterns.h"

#include "index/error.h"

#include <fmt/format.h>

#include <glob.h>

#include <memory>
#include <system_error>

namespace isochron::app {

std::vector<std::filesystem::path> expand_patterns(const std::vector<std::string>& arguments) {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (const std::string& argument : arguments) {
        // A file may have brackets in its name: an existing file is a name, not a pattern.
        if (std::filesystem::exists(argument, ignored) ||
            argument.find_first_of("*?[") == std::string::npos) {
            files.emplace_back(argument);
            continue;
        }
        glob_t found{};
        const std::unique_ptr<glob_t, decltype(&globfree)> owner(&found, globfree);
        if (::glob(argument.c_str(), 0, nullptr, &found) != 0)
            throw index::Error(fmt::format("{}: no file matches", argument));
        files.insert(files.end(), found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    return files;
}

std::optional<std::string> take_path_within(std::vector<std::string>& arguments) {
    std::optional<std::string> found;
    std::error_code ignored;
    for (std::string& argument : arguments) {
        const std::size_t colon = argument.find(":/");
        if (colon == std::string::npos || colon == 0 || std::filesystem::exists(argument, ignored))
            continue;
        const std::string path = argument.substr(colon + 1);
        if (found && *found != path)
            throw index::Error(
                fmt::format("{}: another path than {}, expected one array", argument, *found));
        found = path;
        argument.resize(colon);
    }
    return found;
}

} // namespace isochron::app
