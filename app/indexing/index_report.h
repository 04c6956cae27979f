// What an index holds, as text and as JSON.
#pragma once

#include "app/safe_text.h"
#include "index/file/index_file.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace isochron::app {

struct IndexReport {
    std::string name; ///< as the user gave it
    const index::IndexFile& file;
    bool tree = false;   ///< report the cells of every time node as well
    bool blends = false; ///< measure anew how well blends stand for what lies between the steps
};

/// Sizes of the whole file and of its parts, also where `file` is one of several arrays: `4.10 MiB:
/// volume 3.00 MiB, bricks 12 KiB, cells 1.05 MiB`.
std::string file_sizes(const index::IndexFile& file);
/// The sizes of one array alone.
std::string array_sizes(const index::IndexFile& array);

/// An array's name, type, values and search structures.
nlohmann::ordered_json array_json(const index::IndexFile& array);

/// @throws index::Error when the tree is damaged
SafeText as_text(const IndexReport& report);
nlohmann::ordered_json as_json(const IndexReport& report);

} // namespace isochron::app
