// The words of a command, for tests that run one.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace isochron::app {

/// Parted at spaces: nothing is quoted.
inline std::vector<std::string> as_words(const std::string& command) {
    std::istringstream line(command);
    return {std::istream_iterator<std::string>(line), {}};
}

} // namespace isochron::app
