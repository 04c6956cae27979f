// Paths of this checkout and this build.
#include "tests/support/paths.h"

namespace isochron::test_support {

std::string source_root() {
    return SOURCE_ROOT;
}

std::string binary_root() {
    return BINARY_ROOT;
}

std::string test_data() {
    return SOURCE_ROOT "/tests/data";
}

} // namespace isochron::test_support
