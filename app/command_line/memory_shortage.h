// Keeps memory that was freed; tells in one line that the process has run out of memory.
#pragma once

namespace isochron::app {

/// Lets each arena keep up to 16 MiB that the process has freed: given back to Linux at once, all pages
/// of a search's results fault again in the next search.
void keep_freed_memory();

/// Where the address space is limited (ulimit -v), prepares for its end: threads share what they
/// allocate from, which takes less address space, and a library that crashes because it gets no memory,
/// as drivers of OpenGL do, ends the process with the same line and exit status 1. Call it before there
/// are other threads. @param program before the line; lives on
void prepare_for_shortage(const char* program);

} // namespace isochron::app
