// Loading of the program's own modules on demand: heavy libraries stay out of its start.
#pragma once

#include <string>

namespace isochron::index {

/// Address of `symbol` in `lib<name>.so`, which lies beside the program or in ../lib/isochron.
/// The module stays loaded. @throws Error naming the module and what the loader said
void* module_symbol(const std::string& name, const std::string& symbol);

} // namespace isochron::index
