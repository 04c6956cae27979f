// Names and patterns of input files, as a user gives them.
#include "app/commands/file_patterns.h"

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
        // A file may well have brackets in its name: what exists is a name.
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

void refuse_input_as_output(const std::vector<std::filesystem::path>& files,
                            const std::filesystem::path& out) {
    std::error_code ignored;
    for (const std::filesystem::path& file : files)
        if (std::filesystem::equivalent(file, out, ignored))
            throw index::Error(
                fmt::format("{}: is an input, it would be overwritten", out.string()));
}

} // namespace isochron::app
