// `isochron serve`: indices on a web page, for this machine or for others; or as plain files for any
// web server.
#include "app/command_line/cancel.h"
#include "app/command_line/subcommands.h"
#include "app/control/control_address.h"
#include "app/explore/story_file.h"
#include "app/indexing/open_index.h"
#include "app/kept/session_file.h"
#include "app/loop/movie_maker.h"
#include "app/safe_text.h"
#include "app/serve/http_server.h"
#include "app/telling.h"
#include "app/text.h"
#include "index/error.h"
#include "index/file/sections/file_layout.h"
#include "index/system/input_file.h"
#include "index/system/module.h"
#include "index/system/new_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <memory>
#include <poll.h>
#include <sstream>
#include <string>
#include <sys/eventfd.h>
#include <unistd.h>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;

struct ServeArguments {
    std::vector<fs::path> files;
    std::string address = "127.0.0.1";
    std::uint32_t port = 0;
    fs::path write_site, certificate, key, story;
    bool no_token = false, follow = false;
};

const SiteModule& site_module() {
    return *static_cast<const SiteModule*>(
        index::module_symbol("isochron_site", "isochron_site_module"));
}

/// Whether a folder is empty, not there yet, or one that this command has written.
bool is_own(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error))
        return true;
    if (!fs::is_directory(folder, error))
        return false;
    if (fs::is_empty(folder, error))
        return true;
    std::ifstream list(folder / "site.json");
    std::string words(64, '\0');
    list.read(words.data(), static_cast<std::streamsize>(words.size()));
    return words.find("\"isochron site\"") != std::string::npos;
}

/// Refuses what the page would refuse, and what is not to be shown to others.
void check_story(const fs::path& story) {
    if (!is_story_name(story.string()))
        throw UsageError("--story {}: expected a file NAME{}", story.string(), kStoryEnding);
    const std::string text = index::read_text(story, kLargestStory);
    if (is_session_text(text))
        throw index::Error("{}: a session, which names folders of this machine: expected a story, "
                           "as \"save as story\" in the list of keys makes it",
                           story.string());
    story_in(text, story.string());
}

void write_site(const ServeArguments& arguments) {
    const fs::path& folder = arguments.write_site;
    if (!is_own(folder))
        throw index::Error("{}: expected a new or empty folder, or one that `isochron serve "
                           "--write-site` wrote; nothing is written",
                           folder.string());
    std::vector<fs::path> all = arguments.files;
    if (!arguments.story.empty())
        all.push_back(arguments.story);
    std::uintmax_t bytes = 0;
    for (const fs::path& file : all)
        bytes += fs::file_size(file);
    print_note("writing {}: {}", folder.string(), human_bytes(static_cast<double>(bytes)));
    const CancelOnSignal signals;
    fs::create_directories(folder);
    // It looks at the names first, and makes the folder one that may be written again.
    site_module().write_page(folder, {.files = arguments.files, .story = arguments.story});
    for (const fs::path& file : all) {
        const fs::path copy = folder / file.filename();
        if (fs::exists(copy) && fs::equivalent(copy, file))
            continue;
        const index::InputFile in(file);
        index::NewFile out(copy);
        std::vector<std::byte> block(4 << 20);
        for (std::uint64_t at = 0; at < in.size();) {
            signals.check();
            const std::size_t count = in.read(at, block);
            if (count == 0)
                throw index::Error(file.string() + ": became shorter while it was copied");
            out.write_at(at, std::span(block).first(count));
            at += count;
        }
        out.commit();
    }
    tell_result({{"folder", folder.string()}, {"bytes", bytes}});
    print_report(
        "wrote {}: put it on any web server that answers ranges; a link to its folder opens "
        "the page\n",
        folder.string());
    print_note(
        "an index holds the names of its source files and their notes (isochron info shows them)");
}

/// The state of an index that was written whole last: while more is appended, its bytes stay as they are.
std::optional<ServedFile> written_of(const fs::path& file) {
    try {
        const index::FileHeader header = index::checked_header(*index::open_bytes(file));
        return ServedFile{header.file_bytes,
                          fmt::format("\"{:x}-{:x}\"", header.content_hash, header.checksum)};
    } catch (const index::Error&) { // it is being replaced
        return std::nullopt;
    }
}

/// Waits without using the processor.
void wait_for_signal() {
    struct Event {
        int file = eventfd(0, EFD_CLOEXEC);
        ~Event() { close(file); }
    };
    const auto event = std::make_shared<const Event>();
    const WakeOnSignal wake(event, [](const void* who) {
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto written =
            write(static_cast<const Event*>(who)->file, &one, sizeof one);
    });
    pollfd ready{event->file, POLLIN, 0};
    while (!CancelOnSignal::received())
        poll(&ready, 1, -1);
}

void run_serve(const ServeArguments& arguments) {
    for (const fs::path& file : arguments.files)
        if (open_index(file)->referral())
            throw index::Error("{}: has no copy of its values (it was built with --refer); "
                               "isochron build {} -o NEW.isochron makes one that has",
                               file.string(), file.string());
    if (!arguments.story.empty())
        check_story(arguments.story);
    if (arguments.follow && !arguments.write_site.empty())
        throw UsageError(
            "--follow: files on another web server do not grow; expected it without --write-site");
    if (!arguments.write_site.empty())
        return write_site(arguments);
    if (arguments.certificate.empty() != arguments.key.empty())
        throw UsageError("--certificate and --key: expected both, or neither");
    const auto text_of = [](const fs::path& file) {
        constexpr std::uint64_t kMost = 1 << 20;
        return file.empty() ? std::string() : index::read_text(file, kMost);
    };
    const std::string token = arguments.no_token ? "" : new_control_token();
    const CancelOnSignal signals;
    SiteParts parts{.files = arguments.files, .token = token, .story = arguments.story};
    if (arguments.follow)
        parts.written = written_of;
    const auto server =
        site_module().serve(std::move(parts), {.address = arguments.address,
                                               .port = static_cast<std::uint16_t>(arguments.port),
                                               .certificate = text_of(arguments.certificate),
                                               .key = text_of(arguments.key)});
    const bool all = arguments.address == "0.0.0.0" || arguments.address == "::";
    const std::string host = all ? "THIS-MACHINE"
                             : arguments.address.find(':') != std::string::npos
                                 ? "[" + arguments.address + "]"
                                 : arguments.address;
    const std::string link =
        fmt::format("http{}://{}:{}/{}", arguments.certificate.empty() ? "" : "s", host,
                    server->port(), token.empty() ? "" : "#token=" + token);
    tell_result({{"link", link}});
    print_answer("{}\n", link);
    print_result(); // now: whoever reads it wants to open it
    std::fflush(stdout);
    // A camera reads what is not of this machine alone.
    if (isatty(STDERR_FILENO) != 0 && !all && !arguments.address.starts_with("127.") &&
        arguments.address != "::1")
        for (std::istringstream code(site_module().qr_code(link)); code;) {
            std::string line;
            if (std::getline(code, line))
                print_safely(stderr, "{}\n", line);
        }
    print_note("serving until Ctrl+C");
    wait_for_signal();
}

} // namespace

void add_serve(Command& program) {
    auto arguments = std::make_shared<ServeArguments>();
    Command command = program.subcommand(
        "serve", "Show indices on a web page, to browsers on this machine or on others.");
    command.examples(
        {"isochron serve run42.isochron", "isochron serve run42.isochron --write-site site/"});
    command.option("files INDEX", arguments->files, "Indices to serve; the page shows the first")
        .required();
    command
        .option("--address ADDRESS", arguments->address,
                "Address to listen on: 0.0.0.0 lets all machines of the network ask")
        .shows_default();
    command.option("--port PORT", arguments->port, "Port to listen on (default: one that is free)")
        .between(0u, 65535u);
    command.option(
        "--certificate FILE", arguments->certificate,
        "Certificate in PEM, to serve by https: headsets open the page in VR only by https or "
        "from localhost");
    command.option("--key FILE", arguments->key, "Private key of the certificate, in PEM");
    command.flag("--no-token", arguments->no_token,
                 "Let everybody who reaches the address open the page, without the token of the "
                 "printed link");
    command.flag("--follow", arguments->follow,
                 "Show steps that `build --append` adds meanwhile, to whoever has the page or the "
                 "link open");
    command.option(
        "--story FILE", arguments->story,
        "Tell the story in this file on the page, on the first index: NAME.isochron-story "
        "(docs/guide/stories.md)");
    command.option(
        "--write-site FOLDER", arguments->write_site,
        "Write the page and the indices into this folder instead, as plain files for any web "
        "server");
    command.footer(
        "The page reads ranges of the files and searches in the browser; the server only "
        "sends bytes of these files. docs/guide/sharing.md says what other servers need.");
    command.on_run([arguments] { run_serve(*arguments); });
}

} // namespace isochron::app
