// The configuration of a small CAVE, for jobs of several processes.
#pragma once

#include "app/config/config.h"

#include <string>

namespace isochron::app {

/// A CAVE of four small walls on nodes 1 to 4, whose windows stand on a desktop.
inline std::string small_cave(const std::string& more = "") {
    std::string text = read_config("cave4").text;
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
            text.replace(at, from.size(), to);
    };
    replace("size = [1920, 1200]", "size = [64, 40]");
    replace("fullscreen = true\n", "");
    return text + more;
}

/// The same where no window has buffers for two eyes.
inline std::string mono_cave(const std::string& more = "") {
    std::string text = small_cave(more);
    for (std::size_t at; (at = text.find("\"quadbuffer\"")) != text.npos;)
        text.replace(at, 12, "\"mono\"");
    return text;
}

} // namespace isochron::app
