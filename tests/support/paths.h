// Paths of the checkout and the build, for tests. Only one source has them compiled in, so that
// other clones can use the same compiler cache for all others.
#pragma once

#include <string>

namespace isochron::test_support {

std::string source_root(); ///< the checkout
std::string binary_root(); ///< folder of the built programs
std::string test_data();   ///< tests/data

} // namespace isochron::test_support
