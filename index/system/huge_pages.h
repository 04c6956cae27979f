// Large memory in large pages.
#pragma once

#include <cstddef>

namespace isochron::index {

/// Asks for pages of 2 MiB where these bytes, which have not been touched, span some: a fraction of
/// the time that small ones take to come. Does nothing where the system has none.
void ask_for_huge_pages(const void* memory, std::size_t bytes);

} // namespace isochron::index
