// Counts what Mesa's llvmpipe compiles in this process.
#pragma once

namespace isochron::test_support {

/// Functions that llvmpipe has made of shaders and states so far, be it from its cache on the disk;
/// 0 with drivers that do not use LLVM, or have it within.
int compilations();

} // namespace isochron::test_support
