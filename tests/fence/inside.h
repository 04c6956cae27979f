// Runs code inside the fence, in a process of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace isochron::test_support {

/// What a child process inside the fence found: a line for each surprise. How it ended otherwise is
/// a line, too.
/// @param inside called in the child; what it returns comes back
std::string surprises_inside(std::span<const std::filesystem::path> readable,
                             const std::function<std::string()>& inside);

} // namespace isochron::test_support
