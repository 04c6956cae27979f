// What is looked at in XML before VTK gets it.
#pragma once

#include <string>
#include <string_view>

namespace isochron::index {

/// VTK's parsers descend into elements by recursion, and take quadratic time before.
/// @throws Error naming the file when elements are nested deeper than in any file of VTK's
void expect_shallow(std::string_view markup, const std::string& file);

} // namespace isochron::index
