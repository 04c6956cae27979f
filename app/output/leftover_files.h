// Temporary files that earlier commands left behind because they were killed.
#pragma once

namespace isochron::app {

/// Removes temporary files of killed commands from the folders of the files that the arguments
/// name, see index::remove_remains_in.
void remove_leftover_files(int argc, const char* const* argv) noexcept;

} // namespace isochron::app
