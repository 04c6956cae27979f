// The build and the machine that figures come from.
#pragma once

#include <string>

namespace isochron::bench {

struct Header {
    std::string commit, processor, compiler, date;
    unsigned threads = 0; ///< threads of the processor
};

} // namespace isochron::bench
