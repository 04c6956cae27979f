// The main function of a reader process.
#pragma once

#include "index/readers/decoders/reader_service.h"

#include <span>

namespace isochron::index {

/// What `main` of a reader calls: serves, behind the fence, the program that started it until that
/// ends. @return exit status
int run_reader(std::span<const Decoder> decoders, const OtherFiles& others = {});

} // namespace isochron::index
