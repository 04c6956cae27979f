// The rows of the motion benchmark as JSON and as a table.
#pragma once

#include "tests/bench/motion/row.h"
#include "tests/bench/rows/header.h"

#include <string>
#include <vector>

namespace isochron::bench {

struct MotionResults {
    Header header;
    std::vector<MotionRow> rows;
};
std::string to_json_text(const MotionResults& results);

/// For a terminal: what the columns are, and a row.
std::string motion_table_head();
std::string motion_table_line(const MotionRow& row);

} // namespace isochron::bench
