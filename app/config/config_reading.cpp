// Reading of configuration files.
#include "app/config/config.h"

#include "app/config/shipped_configs.h"
#include "app/config/table_reader.h"
#include "app/safe_text.h"
#include "app/text.h"
#include "index/error.h"
#include "index/system/input_file.h"
#include "stereo/screen.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>

namespace isochron::app {
namespace {

constexpr std::uint64_t kMostBytes = 16 << 20; ///< largest configuration file

} // namespace

std::string unknown_word(const char* what, const std::string& word,
                         const std::vector<std::string>& known) {
    const std::string near = nearest_word(word, known);
    return fmt::format("unknown {} '{}', expected one of {}{}", what, word, fmt::join(known, ", "),
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
}

interaction::EmulationOptions emulation_for(const Config& config) {
    interaction::EmulationOptions options = config.emulation;
    const stereo::Window& window = config.installation.windows.front();
    options.vertical_fov =
        stereo::vertical_field_of_view(window.viewports.front().screen, options.head);
    return options;
}

Config parse_config(const std::string& text, const std::string& name) {
    Config config;
    config.name = name;
    config.text = text;
    try {
        const toml::table table = toml::parse(text, name);
        const TomlTable file(table, name, "");
        TableReader(config).read(file, config);
        file.finish();
    } catch (const toml::parse_error& error) {
        throw ConfigError(one_line(
            fmt::format("{}:{}: {}", name, error.source().begin.line, error.description())));
    }
    return config;
}

Config read_config(const std::filesystem::path& path) {
    // A shipped name means the shipped configuration, even if the working directory has such a
    // file.
    if (const auto shipped = shipped_config(path.string()))
        return parse_config(*shipped, path.string());
    std::string text;
    try {
        text = index::read_text(path, kMostBytes);
    } catch (const index::Error& error) {
        throw ConfigError("{}; expected a TOML file or the name of a shipped configuration ({})",
                          error.what(), fmt::join(shipped_config_names(), ", "));
    }
    return parse_config(text, path.string());
}

} // namespace isochron::app
