// The part of the page of results on the paper's two sources of error.
#pragma once

#include "tests/bench/measures/artifacts.h"

#include <string>

namespace isochron::bench {

/// Markdown that follows the parts on the index and on rendering.
/// @param source name of the results' file on the page
std::string artifact_section(const ArtifactResults& results, const std::string& source);

} // namespace isochron::bench
