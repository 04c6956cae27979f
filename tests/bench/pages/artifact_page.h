// The part of the page of results that is about the paper's two sources of error.
#pragma once

#include "tests/bench/measures/artifacts.h"

#include <string>

namespace isochron::bench {

/// Markdown, to follow the parts about the index and about rendering.
/// @param source the file that the results come from, as the page names it
std::string artifact_section(const ArtifactResults& results, const std::string& source);

} // namespace isochron::bench
