// The configuration of a small CAVE, for jobs of several processes and for programs that draw it.
#pragma once

#include "app/config/config.h"

#include <string>

namespace isochron::app {

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

/// The CAVE with walls of so many pixels. @param pixels `64, 40`, as a configuration has it
inline std::string cave_of(const std::string& pixels) {
    return replaced(read_config("cave4").text, "size = [1920, 1200]", "size = [" + pixels + "]");
}

/// A CAVE of four small walls on nodes 1 to 4, whose windows stand on a desktop.
inline std::string small_cave(const std::string& more = "") {
    return replaced(cave_of("64, 40"), "fullscreen = true\n", "") + more;
}

/// The CAVE where no window has buffers for two eyes.
inline std::string mono_cave(const std::string& more = "") {
    return replaced(small_cave(more), "\"quadbuffer\"", "\"mono\"");
}

} // namespace isochron::app
