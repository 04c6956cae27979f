// Describes a place in the data, which a user picked or points at, in words.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/commands.h"
#include "interaction/pointed.h"

#include <cstddef>
#include <string>
#include <vector>

namespace isochron::app {

/// `12.5, 3, -4.25 mm: 37.2 K at 0.35 s`: the place, the data there, and when. Between two
/// steps it says so: `at 0.35 s, between steps 4 and 5`.
std::string mark_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info);

/// The text in lines: value, place, time.
std::vector<std::string> mark_lines(const interaction::MarkedPoint& point,
                                    const index::SeriesInfo& info);

/// Lines about the place under the cursor: value, place, between which steps if a blend of two is
/// shown, and, of several surfaces, which one.
std::vector<std::string> pointed_lines(const interaction::Pointed& pointed, std::size_t surfaces,
                                       const index::SeriesInfo& info);

} // namespace isochron::app
