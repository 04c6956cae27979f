// `generate` and its options: of isochron, and of isochron-generate, which makes the series.
#pragma once

#include "app/command_line/command_line.h"
#include "app/generate/demo_fields.h"

#include <filesystem>
#include <functional>
#include <variant>

namespace isochron::app {

/// What the options ask for.
struct DemoRequest {
    std::variant<SphereSeries, VorticitySeries, FourierSeries> series;
    std::filesystem::path dir; ///< to write to
    bool force = false;        ///< replaces another series, and files of other origin
};

/// Adds `generate` with a subcommand for each series.
/// @param run gets the subcommand that was called, and what it asks for
void add_generate_options(Command& program,
                          const std::function<void(const Command&, const DemoRequest&)>& run);

} // namespace isochron::app
