// The example in a header: the indented lines in the comment at its beginning.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace isochron::house {

inline constexpr std::string_view kExampleIndent = "//     ";

struct Example {
    int line = 0; ///< number of its first line, from 1
    std::string
        text; ///< the code, one line for each line of the comment, from the first to the last
};

/// @return nothing where the file's first comment has no example
inline std::optional<Example> example_of(const std::filesystem::path& header) {
    std::ifstream file(header);
    std::optional<Example> example;
    std::string line, gap;
    for (int number = 1; std::getline(file, line) && line.starts_with("//"); ++number) {
        if (!line.starts_with(kExampleIndent)) {
            gap += '\n'; // prose between two parts of an example
            continue;
        }
        if (!example)
            example = Example{number, {}};
        else
            example->text += gap;
        gap.clear();
        example->text += line.substr(kExampleIndent.size()) + '\n';
    }
    return example;
}

} // namespace isochron::house
