// Names and patterns of input files, as a user gives them.
#include "app/indexing/file_patterns.h"

#include "index/missing_file.h"
#include "index/name_pattern.h"
#include "index/system/links/link.h"

#include <glob.h>

#include <memory>
#include <system_error>

namespace isochron::app {

namespace {

namespace fs = std::filesystem;

/// The folders that are there stand for themselves, whatever characters are in their names.
std::string with_folders_as_they_are(const std::string& pattern) {
    fs::path there, text;
    bool is_there = true;
    std::error_code ignored;
    for (const fs::path& part : fs::path(pattern)) {
        is_there = is_there && fs::exists(there / part, ignored);
        there /= part;
        text /= is_there ? index::escaped(part.string(), "*?[\\") : part.string();
    }
    return text.string();
}

/// The files that match, sorted by name.
std::vector<fs::path> matching(const std::string& pattern) {
    glob_t found{};
    const std::unique_ptr<glob_t, decltype(&globfree)> owner(&found, globfree);
    if (::glob(pattern.c_str(), 0, nullptr, &found) != 0)
        return {};
    return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

} // namespace

std::vector<fs::path> expand_patterns(const std::vector<std::string>& arguments) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const std::string& argument : arguments) {
        if (index::is_link(argument))
            throw index::Error("{}: files of values are not read by a link, and neither is an "
                               "index to build of: download it",
                               argument);
        // A file may have brackets in its name: an existing file is a name, not a pattern.
        if (fs::exists(argument, ignored) || argument.find_first_of("*?[") == std::string::npos) {
            files.emplace_back(argument);
            continue;
        }
        const std::string pattern = with_folders_as_they_are(argument);
        std::vector<fs::path> found = matching(pattern);
        if (found.empty())
            found = matching(index::escaped(argument, "["));
        if (found.empty())
            throw index::MissingFile("{}: no file matches", argument);
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

std::optional<std::string> take_path_within(std::vector<std::string>& arguments) {
    std::optional<std::string> found;
    std::error_code ignored;
    for (std::string& argument : arguments) {
        const std::size_t colon = argument.find(":/");
        if (index::is_link(argument) || colon == std::string::npos || colon == 0 ||
            fs::exists(argument, ignored))
            continue;
        const std::string path = argument.substr(colon + 1);
        if (found && *found != path)
            throw index::Error("{}: another path than {}, expected one array", argument, *found);
        found = path;
        argument.resize(colon);
    }
    return found;
}

} // namespace isochron::app
