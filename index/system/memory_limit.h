// How much memory this process may have.
#pragma once

#include <cstdint>

namespace isochron::index {

/// Bytes: the machine's memory, or less where a control group or a resource limit says so.
std::uint64_t memory_limit();

} // namespace isochron::index
