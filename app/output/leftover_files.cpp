// Files that killed commands have left.
#include "app/output/leftover_files.h"

#include "index/system/new_file.h"

#include <unistd.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace isochron::app {

namespace {

namespace fs = std::filesystem;

void remove_files_beside(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) {
        std::string_view word = argv[i];
        if (word.starts_with('-')) // --out=FILE
            word.remove_prefix(std::min(word.find('='), word.size() - 1) + 1);
        std::error_code ignored;
        const fs::path file = fs::absolute(word, ignored);
        if (word.empty() || ignored)
            continue;
        for (const fs::path& folder : {file, file.parent_path()})
            if (fs::is_directory(folder, ignored) && ::access(folder.c_str(), W_OK) == 0)
                index::remove_remains_in(folder);
    }
}

} // namespace

void remove_leftover_files(int argc, const char* const* argv) noexcept {
    try {
        remove_files_beside(argc, argv);
    } catch (const std::exception&) { // they stay for the next command
    }
}

} // namespace isochron::app
