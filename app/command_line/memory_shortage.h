// Tells in one line that the process has run out of memory.
#pragma once

namespace isochron::app {

/// Where the address space is limited (ulimit -v), prepares for its end: threads share what they
/// allocate from, which takes less address space, and a library that crashes because it gets no memory,
/// as drivers of OpenGL do, ends the process with the same line and exit status 1. Call it before there
/// are other threads. @param program before the line; lives on
void prepare_for_shortage(const char* program);

} // namespace isochron::app
