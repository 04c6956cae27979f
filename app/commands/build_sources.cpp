// Opening of sources, and options from arguments.
#include "app/commands/build_sources.h"

#include "index/file/index_series.h"

namespace isochron::app {

BuildSources open_sources(const std::vector<std::filesystem::path>& files,
                          const BuildArguments& arguments) {
    BuildSources sources;
    // An index is a series too: of an older file version it becomes one of this.
    if (files.size() != 1 || !index::is_index(files.front())) {
        sources.volume = index::open_series(files, read_options(arguments));
        if (arguments.color)
            sources.colors = index::open_series(files, color_options(arguments));
        return sources;
    }
    if (arguments.refer)
        throw UsageError("--refer: an index has no files of values to refer to");
    sources.volume = index::open_index_series(files.front(), read_options(arguments));
    index::ReadOptions of_colors = color_options(arguments);
    if (!of_colors.array)
        of_colors.array = index::color_of_index(files.front());
    if (of_colors.array)
        sources.colors = index::open_index_series(files.front(), of_colors);
    return sources;
}

index::BuildOptions build_options(const BuildArguments& arguments, const BuildSources& sources) {
    index::BuildOptions options = arguments.build;
    if (!arguments.tiers.empty())
        options.tiers = tiers_of(arguments.tiers);
    if (!arguments.codec.empty())
        options.codec = *index::codec_from_name(arguments.codec);
    options.array = arguments.read.array;
    options.component = arguments.read.component;
    options.color_array = arguments.color;
    options.color_component = arguments.color_component;
    options.color = sources.colors.get();
    return options;
}

} // namespace isochron::app
