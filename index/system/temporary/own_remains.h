// Temporary files of a process that ends without its destructors.
#pragma once

namespace isochron::index {

/// Removes all that stands in the ledger (remains.h) for this process. Other threads may go on: what
/// they add is left to later commands.
void remove_own_remains() noexcept;

} // namespace isochron::index
