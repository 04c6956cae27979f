// Checks that end the program when they fail.
#include "tests/fuzz/claims.h"

#include <cstdio>
#include <cstdlib>

namespace isochron::fuzz {

void claim(bool holds, const char* what) {
    if (holds)
        return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

void claim_one_line(std::string_view message) {
    claim(!message.empty(), "an error says something");
    claim(message.find('\n') == message.npos, "an error is one line");
}

} // namespace isochron::fuzz
