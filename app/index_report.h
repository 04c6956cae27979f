// What an index holds, as text and as JSON.
#pragma once

#include "index/index_file.h"

#include <string>

namespace isochron::app {

struct IndexReport {
    std::string name; ///< as the user gave it
    const index::IndexFile& file;
    bool tree = false;     ///< with the cells of every time node
    bool verified = false; ///< say that all checksums matched
};

/// @throws index::Error when the tree is damaged
std::string as_text(const IndexReport& report);
std::string as_json(const IndexReport& report);

} // namespace isochron::app
