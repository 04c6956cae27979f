// The fence: restricts a reader process, even if a hostile file takes over the library that decodes
// it.
#pragma once

namespace isochron::index {

/// From now on this process, with all its threads, can open files for reading only. It cannot
/// connect to anything, start programs or touch other processes: these calls fail with EPERM.
/// Without seccomp in the build or the system, only the other restrictions hold: no new privileges,
/// no file grows, no core dump.
/// @return whether all restrictions hold
bool fence_in();

} // namespace isochron::index
