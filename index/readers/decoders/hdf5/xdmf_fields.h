// What an XDMF document states and nobody reads.
#pragma once

#include <string>
#include <vector>

namespace tinyxml2 {
class XMLDocument;
}

namespace isochron::index {

/// As `note_on_unread` takes them: each kind of field once, with the value that is there first.
std::vector<std::string> unread_of_xdmf(const tinyxml2::XMLDocument& document);

} // namespace isochron::index
