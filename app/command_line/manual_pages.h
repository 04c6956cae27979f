// Manual pages of the program and its commands, section 1.
#pragma once

#include "app/command_line/command_reference.h"

#include <string>
#include <vector>

namespace isochron::app {

struct ManualPage {
    std::string file; ///< name of the file, such as isochron-generate-sphere.1
    std::string text; ///< roff with the macros of man(7)
};

/// A page for the program and one for each command. `version` stands in their footers.
std::vector<ManualPage> manual_pages(const CommandReference& program, const std::string& version);

} // namespace isochron::app
