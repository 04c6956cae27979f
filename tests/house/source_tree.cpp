// Reads the source tree for its tests.
#include "tests/house/source_tree.h"

#include "tests/support/paths.h"

#include <algorithm>
#include <fstream>
#include <regex>

namespace isochron::house {

namespace fs = std::filesystem;

fs::path checkout() {
    return test_support::source_root();
}

std::vector<std::string> sources(const fs::path& root, const std::string& folder) {
    std::vector<std::string> found;
    if (!fs::exists(root / folder))
        return found;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension == ".h" || extension == ".cpp")
            found.push_back(fs::relative(entry.path(), root).generic_string());
    }
    std::ranges::sort(found);
    return found;
}

std::vector<Include> includes_of(const fs::path& file) {
    static const std::regex kInclude(R"(^\s*#\s*include\s*["<]([a-z]+/[^">]+)[">])");
    std::vector<Include> found;
    std::ifstream text(file);
    std::string line;
    std::smatch match;
    for (int number = 1; std::getline(text, line); ++number)
        if (std::regex_search(line, match, kInclude))
            found.push_back({number, match[1].str()});
    return found;
}

void PlantedTree::plant(const std::string& path, const std::string& text) const {
    fs::create_directories((root() / path).parent_path());
    folder_.write(path, text);
}

} // namespace isochron::house
