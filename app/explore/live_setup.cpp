// What a live session is given to work with.
#include "app/explore/live_setup.h"

#include "app/command_line/cancel.h"
#include "app/explore/explored_data.h"
#include "app/explore/kept_session.h"
#include "app/explore/story_file.h"
#include "app/indexing/build_sources.h"
#include "app/indexing/file_patterns.h"
#include "app/indexing/open_index.h"
#include "app/kept/earlier_sessions.h"
#include "app/kept/session_picture.h"
#include "app/telling.h"
#include "app/version.h"
#include "index/error.h"
#include "index/system/links/link.h"
#include "index/system/module.h"
#include "index/system/new_file.h"
#include "index/system/user_folders.h"
#include "interaction/navigation/key_frames.h"

#include <cerrno>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace isochron::app {

namespace {

/// A series to try the program with; empty: there is no folder for it.
std::filesystem::path demo_data() {
    const auto folder = index::user_cache_folder();
    return folder ? *folder / "demo" / "fourier.pvd" : std::filesystem::path();
}

/// Whether a program ends well; its output is left out.
bool runs_well(std::vector<std::string> command) {
    std::vector<char*> words;
    for (std::string& word : command)
        words.push_back(word.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int file : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_WRONLY, 0);
    pid_t process = 0;
    const int failure =
        posix_spawn(&process, words.front(), &files, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    int status = 0;
    while (failure == 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return failure == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Makes the demo, which takes a second. @throws index::Error when it cannot be made
void make_demo(const std::filesystem::path& demo) {
    index::make_folder(demo.parent_path());
    const std::vector<std::string> command{index::file_of_program("isochron-generate").string(),
                                           "fourier",
                                           "--out",
                                           demo.parent_path().string(),
                                           "--size",
                                           "64",
                                           "--steps",
                                           "24",
                                           "--force"};
    if (!runs_well(command))
        throw index::Error("the demo data cannot be made in " + demo.parent_path().string());
}

} // namespace

FileWindow::Offers offers_beside_files(BackgroundWork& reading) {
    using Pictures = std::map<std::filesystem::path, std::string>;
    const auto folder = index::user_state_folder();
    if (!folder)
        return {.demo = demo_data(), .picture = {}};
    // Used by the background alone.
    const auto pictures = std::make_shared<std::optional<Pictures>>();
    return {.demo = demo_data(),
            .picture = [&reading, pictures, folder](const std::filesystem::path& data) {
                return picture_read(reading, [pictures, folder, data] {
                    if (!*pictures)
                        *pictures = newest_pictures(*folder);
                    const auto found = (*pictures)->find(data);
                    return found == (*pictures)->end() ? std::string() : found->second;
                });
            }};
}

std::shared_future<render::Image> picture_read(BackgroundWork& reading,
                                               std::function<std::string()> png) {
    const auto read = std::make_shared<std::promise<render::Image>>();
    auto picture = read->get_future().share();
    reading.post([&reading, read, png = std::move(png)] {
        std::optional<render::Image> found;
        try {
            if (const std::string bytes = png(); !bytes.empty())
                found = picture_in(bytes);
        } catch (const std::exception&) { // whoever waits for it gets an empty one
        }
        read->set_value(std::move(found).value_or(render::Image()));
        reading.wake();
        return std::string();
    });
    return picture;
}

std::string why_not_open(const std::filesystem::path& data) {
    try {
        std::error_code unknown;
        if (data == demo_data() && !std::filesystem::exists(data, unknown))
            make_demo(data);
        BuildArguments arguments;
        arguments.files = {is_story_name(data.string()) ? data_of_story(data) : data.string()};
        if (is_index_name(arguments.files))
            open_index_to_show(arguments.files.front());
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
            print_note("{}", line);
}

interaction::RecordingHeader header_of(const Session& session, const Config& config,
                                       const index::IndexFile& file, const std::string& path) {
    interaction::RecordingHeader header;
    header.program = kProgram;
    header.configuration = config.text;
    header.data = index::absolute_name(path);
    const glm::ivec2 window = session.outputs().windows()[0].framebuffer_size();
    // An emulated installation is as large as configured.
    if (!session.outputs().windows().room() && session.outputs().windows().number(0) == 0) {
        header.window = {window.x, window.y};
        header.text = session.panel().text_share(window);
    }
    header.data_hash = data_hash_of(file);
    header.reading = file.metadata().reading_number;
    header.start = interaction::kept_state(session.state().as_commands());
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
    session.panel().offer_beside_files(offers_beside_files(writing));
    if (!memory.introduced())
        session.panel().introduce();
    if (session.outputs().room() && !memory.knows_room())
        session.panel().explain_room();
}

} // namespace isochron::app
