// The paper's tree in an open index.
#pragma once

#include "index/file/index_file.h"
#include "index/paper/thi_tree.h"

#include <memory>

namespace isochron::index {

/// The THI tree of an array; null if there is none. Reads and checks it, unless the file's cache
/// still holds it: do not call it on the render thread. @throws Error when it is damaged
std::shared_ptr<const ThiTree> tree_of(const IndexFile& file);

} // namespace isochron::index
