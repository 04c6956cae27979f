// What a reader cannot do, whatever a file makes of the library that decodes it.
#pragma once

namespace isochron::index {

/// From now on this process, with all its threads, opens files for reading only, and neither
/// connects to anything, nor starts programs, nor touches other processes: such calls fail with
/// EPERM. Where the build or the system has no seccomp, only what needs none holds: no new
/// privileges, no file grows, no core is dumped.
/// @return whether all of it holds
bool fence_in();

} // namespace isochron::index
