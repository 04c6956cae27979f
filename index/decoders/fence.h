// The fence: restricts a reader process, even if a hostile file takes over the library that decodes
// it.
#pragma once

namespace isochron::index {

/// From now on this process, with all its threads, can open files for reading only. It cannot
/// connect to anything, start programs, or touch, limit or signal other processes: these calls fail
/// with EPERM. Without libseccomp in the build only the other restrictions are set: no new
/// privileges, no file grows, no core dump.
/// @return whether all restrictions of this build hold; where they do not, nothing may be read
[[nodiscard]] bool fence_in();

} // namespace isochron::index
