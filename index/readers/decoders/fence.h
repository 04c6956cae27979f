// The fence: restricts a reader process, even if a hostile file takes over the library that decodes
// it.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace isochron::index {

/// From now on this process can open files for reading only. It cannot connect to anything, start
/// programs, lock files, or touch, limit or signal other processes: these calls fail with EPERM.
/// Where the kernel has Landlock, it can open only what lies in `readable`, shared libraries and
/// what describes the processors; other files fail with EACCES, the memory of other processes with
/// them. Without libseccomp in the build only Landlock and the other restrictions are set: no new
/// privileges, no file grows, no core dump.
/// @param readable folders with all that is in them, and single files; what is not there is left
///   out. Files that are open stay readable.
/// @return what the system has refused of the restrictions of this build and this kernel, in words;
///   empty: all hold. Where one does not, nothing may be read. They cannot hold where the process has
///   several threads.
[[nodiscard]] std::string_view fence_in(std::span<const std::filesystem::path> readable = {});

} // namespace isochron::index
