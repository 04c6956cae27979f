// The part of the page of results that is about rendering.
#pragma once

#include "tests/bench/pages/render_rows.h"

#include <string>

namespace isochron::bench {

/// Markdown, to follow the page of the index; the same results give the same text.
/// @param source the file that the results come from, as the page names it
std::string render_section(const RenderResults& results, const std::string& source);

} // namespace isochron::bench
