// `isochron tell`: gives commands to a running session, or asks it something.
#include "app/command_line/cancel.h"
#include "app/command_line/subcommands.h"
#include "app/commands/id_file.h"
#include "app/control/control_client.h"
#include "app/output/guarded_outputs.h"
#include "app/telling.h"
#include "index/system/new_file.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"
#include "render/gl/image.h"
#include "stereo/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {
namespace {

using nlohmann::json;

struct TellArguments {
    std::vector<std::string> words;
    std::string socket, token_file;
    std::optional<std::string> out;
    bool now = false, force = false;
};

/// Commands that happen once are said by their name alone.
bool happens_once(std::string_view word) {
    constexpr std::array<std::string_view, 6> kOnce{"screenshot", "copy", "save",
                                                    "quit",       "undo", "redo"};
    return std::ranges::find(kOnce, word) != kOnce.end();
}

/// `step=7`, `quality=fast`, `undo`, or an object as JSON, as what a recording holds.
json commands_of(const std::vector<std::string>& words) {
    json commands = json::object();
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (word.starts_with('{')) {
            const json object = json::parse(word, nullptr, false);
            if (!object.is_object())
                throw UsageError("tell: expected an object as JSON, got {}", word);
            commands.update(object);
        } else if (equals != std::string::npos) {
            const std::string value = word.substr(equals + 1);
            const json parsed = json::parse(value, nullptr, false);
            commands[word.substr(0, equals)] = parsed.is_discarded() ? json(value) : parsed;
        } else if (happens_once(word)) {
            commands[word] = true;
        } else {
            throw UsageError("tell: expected KEY=VALUE, an object as JSON, undo, redo, save, "
                             "screenshot, copy or quit, got {}",
                             word);
        }
    }
    return commands;
}

ControlRequest request_of(const TellArguments& arguments) {
    const std::string& first = arguments.words.front();
    const std::vector<std::string> rest(arguments.words.begin() + 1, arguments.words.end());
    json request;
    if (first == "state" || first == "picture" || first == "cells") {
        request = commands_of(rest);
        request["verb"] = first;
        if (first == "picture")
            request["now"] = arguments.now;
    } else if (first == "subscribe") {
        request = {{"verb", first}, {"to", rest.empty() ? json::array({"state"}) : json(rest)}};
    } else {
        request = {{"verb", "commands"}, {"commands", commands_of(arguments.words)}};
    }
    std::string id;
    return request_from(request.dump(-1, ' ', true, json::error_handler_t::replace), id);
}

void write_picture(const ControlClient::Answer& answer, const std::string& path) {
    const json line = json::parse(answer.line);
    render::Image image{.width = line.at("width"), .height = line.at("height"), .rgba = {}};
    image.rgba.reserve(answer.bytes.size() / 3 * 4);
    for (std::size_t i = 0; i + 2 < answer.bytes.size(); i += 3) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            image.rgba.push_back(std::to_integer<std::uint8_t>(answer.bytes[i + channel]));
        image.rgba.push_back(255);
    }
    stereo::write_image(image, path, line.at("note").get<std::string>());
}

void write_cells(const ControlClient::Answer& answer, const std::string& path) {
    index::write_file(path, answer.bytes);
}

/// Prints events until the session ends, or a signal comes.
void print_events(ControlClient& client) {
    const CancelOnSignal signals;
    constexpr int kLookForSignals = 100; // [ms]
    for (;;) {
        signals.check();
        if (!client.waits_for_more(kLookForSignals))
            continue;
        const auto event = client.next();
        if (!event)
            return;
        print_safely(SafeText::data(event->line + '\n'));
        std::fflush(stdout);
    }
}

void check(const TellArguments& arguments, const ControlRequest& request) {
    const bool writes = request.verb == ControlVerb::picture || request.verb == ControlVerb::cells;
    if (writes != arguments.out.has_value())
        throw UsageError(writes ? fmt::format("tell {}: needs -o FILE", arguments.words.front())
                                : "tell: -o is for picture and cells");
    if (request.verb == ControlVerb::picture && !stereo::is_picture_name(*arguments.out))
        throw UsageError("-o: expected a name that ends in .png, .exr, .tiff or .jpg, got {}",
                         *arguments.out);
    if (writes)
        guard_outputs({{*arguments.out, request.verb == ControlVerb::picture ? OutputKind::picture
                                                                             : OutputKind::ids}},
                      {}, arguments.force);
}

void run_tell(const TellArguments& arguments) {
    ControlRequest request;
    try {
        request = request_of(arguments);
    } catch (const interaction::Error& error) {
        throw UsageError("tell: {}", error.what());
    }
    check(arguments, request);
    ControlClient client(control_address(arguments.socket), arguments.token_file);
    const ControlClient::Answer answer = client.ask(request);
    switch (request.verb) {
    case ControlVerb::picture: write_picture(answer, *arguments.out); break;
    case ControlVerb::cells: write_cells(answer, *arguments.out); break;
    case ControlVerb::subscribe: return print_events(client);
    case ControlVerb::state: {
        const json state = json::parse(answer.line).at("state");
        tell_result(state);
        return print_answer(SafeText::json(state));
    }
    default: break;
    }
    tell_result(json::parse(answer.line));
    if (arguments.out)
        tell_result({{"file", *arguments.out}});
}

} // namespace

void add_tell(Command& program) {
    auto arguments = std::make_shared<TellArguments>();
    Command command = program.subcommand(
        "tell",
        "Give commands to a running session, which `explore --control` began, or ask it for "
        "its state, a picture or cells.");
    command.examples({"isochron tell step=2 isovalue=100", "isochron tell picture -o now.png"});
    command
        .option("words COMMAND", arguments->words,
                "Commands: KEY=VALUE with the keys of a recording's commands, an object of them as "
                "JSON, or a word: undo, redo, save, screenshot, copy, quit. Or a question: state; "
                "picture; cells [isovalue=V] [step=N]; subscribe [state] [time] [cells] "
                "[statistics], which prints a line for each event")
        .required();
    command.option("--socket SOCKET", arguments->socket,
                   "Socket of the session: a path, or 127.0.0.1:PORT (default: the socket that "
                   "`explore --control` opens)");
    command.option(
        "--token-file FILE", arguments->token_file,
        "File with the token of 127.0.0.1:PORT (default: the one that the session wrote)");
    command.option(
        "-o,--output,--out FILE", arguments->out,
        "File for a picture, or for the numbers of cells as `query --output` writes them");
    command.flag("--now", arguments->now,
                 "Take the picture as it is, without waiting for all cells and the final quality");
    command.flag("--force", arguments->force, "Let --output replace any file");
    command.footer(
        "The command ends once a frame shows what the commands ask for. A VALUE is JSON, "
        "or a text without quotes. The keys, and what other programs may send to the "
        "socket, are in docs/FORMATS.md.");
    command.on_run([arguments] { run_tell(*arguments); });
}

} // namespace isochron::app
