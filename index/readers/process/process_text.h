// What the system tells of a process or a thread, see proc(5).
#pragma once

#include <fstream>
#include <string>

namespace isochron::index {

/// The text of a file in /proc; empty where it cannot be read, also where its process ends meanwhile:
/// there a stream iterator would throw.
inline std::string process_text(const std::string& path) {
    std::ifstream file(path);
    std::string text;
    std::getline(file, text, '\0');
    return text;
}

} // namespace isochron::index
