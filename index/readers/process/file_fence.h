// The fence around files: what the kernel offers to hide a process's files from it (Landlock).
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>

namespace isochron::index {

/// The version of Landlock that this kernel has, counted from 1; 0 or less where it has none: then
/// a reader can read each file that the user can read.
inline int file_fence_version() {
    constexpr unsigned kAskForVersion = 1; // LANDLOCK_CREATE_RULESET_VERSION
#ifndef SYS_landlock_create_ruleset
    constexpr long SYS_landlock_create_ruleset = 444; // on every architecture
#endif
    return static_cast<int>(
        ::syscall(SYS_landlock_create_ruleset, nullptr, std::size_t{0}, kAskForVersion));
}

} // namespace isochron::index
