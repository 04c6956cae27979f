// Describes a place in the data, which a user picked or points at, in words.
#pragma once

#include "index/volume/volume_series.h"
#include "interaction/commands.h"
#include "interaction/pointed.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace isochron::app {

/// `x 3.42 y 4.41 z 5.60 m, vorticity 9.446 1/s, t 2.908 s`: the place to a tenth of the grid's
/// spacing, the data there, and when. Between two steps it says so: `t 0.35 s, between steps 4 and 5`.
/// @param fits whether there is room for a text: where there is too little, the time is left out, then
/// the place, then the name, but never the value; empty: there is room
std::string mark_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info,
                      const std::function<bool(const std::string&)>& fits = {});

/// `9.446 1/s`: the value there with its unit, in as many digits as the data carry.
std::string value_text(const interaction::MarkedPoint& point, const index::SeriesInfo& info);

/// The text in lines: value with the array's name, place, time.
std::vector<std::string> mark_lines(const interaction::MarkedPoint& point,
                                    const index::SeriesInfo& info);

/// Lines about the place under the cursor: value with the array's name, place, between which steps if a blend of two is
/// shown, and, of several surfaces, which one.
std::vector<std::string> pointed_lines(const interaction::Pointed& pointed, std::size_t surfaces,
                                       const index::SeriesInfo& info);

} // namespace isochron::app
