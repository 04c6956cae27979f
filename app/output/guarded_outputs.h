// What commands may write over: one look at all files that a command is about to write, before it
// writes any of them.
#pragma once

#include "app/output/known_files.h"
#include "index/file/index_file.h"

#include <filesystem>
#include <vector>

namespace isochron::app {

/// What a command reads.
struct Reads {
    /// Files, and folders with all in them.
    std::vector<std::filesystem::path> files = {};
    const index::IndexFile* index = nullptr; ///< with the sources that it was built of
};

/// An output may be new, or replace a file of its kind that this program wrote, or an empty one;
/// with `force` any file. It may never replace what is read, nor a source of the index that is read:
/// neither the same file under another name, nor a file in a folder that is read as a whole, nor one
/// that a file names.
/// @throws index::Error in one line for the first output that may not be written
void guard_outputs(const std::vector<Output>& outputs, const Reads& reads, bool force);

} // namespace isochron::app
