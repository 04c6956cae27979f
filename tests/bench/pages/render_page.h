// The part of the page of results on rendering.
#pragma once

#include "tests/bench/pages/render_rows.h"

#include <string>

namespace isochron::bench {

/// Markdown that follows the part on the index; the same results give the same text.
/// @param source name of the results' file on the page
std::string render_section(const RenderResults& results, const std::string& source);

} // namespace isochron::bench
