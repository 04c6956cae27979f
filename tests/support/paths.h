// Where the tests find the checkout and what was built of it. Said in one source alone, so that
// another clone's compiler cache serves all others.
#pragma once

#include <string>

namespace isochron::test_support {

std::string source_root(); ///< the checkout
std::string binary_root(); ///< where the programs lie that were built
std::string test_data();   ///< tests/data

} // namespace isochron::test_support
