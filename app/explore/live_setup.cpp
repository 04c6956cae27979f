// What a live session is given to work with.
#include "app/explore/live_setup.h"

#include "app/command_line/cancel.h"
#include "app/explore/explored_data.h"
#include "app/explore/kept_session.h"
#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/open_index.h"
#include "app/safe_text.h"
#include "app/version.h"
#include "index/system/module.h"

#include <fmt/format.h>

#include <utility>

namespace isochron::app {

std::string why_not_open(const std::filesystem::path& data) {
    try {
        BuildArguments arguments;
        arguments.files = {data.string()};
        if (is_index_name(arguments.files))
            open_index_to_show(data);
        else
            open_one_or_all(expand_patterns(arguments.files), arguments);
        return {};
    } catch (const std::exception& error) {
        return one_line(error.what());
    }
}

LiveOptions live_options(const ExploreOptions& options) {
    LiveOptions live{.emulated = options.emulate,
                     .length = std::nullopt,
                     .ended = [] { return CancelOnSignal::received() != 0; },
                     .why_not_open = {}};
    if (options.record)
        live.stays = "other data cannot be opened while you record";
    if (options.seconds)
        live.length = interaction::Seconds(*options.seconds);
    return live;
}

void print_status(const LiveLoop& live, const std::vector<std::string>& words) {
    for (const auto& lines : {live.status(), words})
        for (const std::string& line : lines)
            print_safely(stderr, "{}\n", line);
}

interaction::RecordingHeader header_of(const Session& session, const Config& config,
                                       const index::IndexFile& file, const std::string& path) {
    interaction::RecordingHeader header;
    header.program = kProgram;
    header.configuration = config.text;
    header.data = std::filesystem::absolute(path).string();
    const glm::ivec2 window = session.outputs().windows()[0].framebuffer_size();
    // An emulated installation is as large as configured.
    if (!session.outputs().windows().room() && session.outputs().windows().number(0) == 0) {
        header.window = {window.x, window.y};
        header.text = session.panel().text_share(window);
    }
    header.data_hash = data_hash_of(file);
    header.start = session.state().as_commands();
    return header;
}

MovieOrders movie_orders(const ExploreOptions& options, interaction::RecordingHeader header) {
    MovieOrders orders{.program = index::file_of_program("isochron"),
                       .folder = options.screenshots,
                       .options = {},
                       .header = std::move(header)};
    const auto add = [&](const char* name, const std::optional<std::string>& value) {
        if (value)
            orders.options.insert(orders.options.end(), {name, *value});
    };
    add("--footprint", options.footprint);
    add("--shape", options.shape);
    if (options.emulate)
        orders.options.emplace_back("--emulate");
    if (options.emulate && !options.size.empty())
        orders.options.insert(orders.options.end(), {"--size", std::to_string(options.size[0]),
                                                     std::to_string(options.size[1])});
    return orders;
}

void greet(Session& session, UserMemory& memory, BackgroundWork& writing,
           const std::optional<std::string>& data) {
    if (data)
        writing.post([&memory, data = *data] {
            memory.remember(data);
            return std::string();
        });
    session.panel().offer_files([&memory] { return memory.recent(); });
    if (!memory.introduced())
        session.panel().introduce();
    if (session.outputs().room() && !memory.knows_room())
        session.panel().explain_room();
}

} // namespace isochron::app
