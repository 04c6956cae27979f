// A reader as a process.
#pragma once

#include "index/decoders/reader_service.h"

#include <span>

namespace isochron::index {

/// What `main` of a reader does: serves the program that started it, behind the fence, as long as
/// that lives. @return exit status
int run_reader(std::span<const Decoder> decoders, ReadCollectionFile collection = nullptr);

} // namespace isochron::index
