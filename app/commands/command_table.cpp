// `isochron table`: what a session marked, or how long its frames took, as a table.
#include "app/command_line/subcommands.h"
#include "app/commands/csv_rows.h"
#include "app/kept/recording_file.h"
#include "app/kept/session_file.h"
#include "app/output/guarded_outputs.h"
#include "app/output/known_files.h"
#include "app/telling.h"
#include "index/error.h"
#include "index/json_mistake.h"
#include "index/system/new_file.h"
#include "interaction/tools/tool_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct TableArguments {
    fs::path file, out;
    bool keep_formulas = false, force = false;
};

struct Table {
    std::vector<std::string> columns; ///< columns of marks, also where nothing is marked
    Json rows;
};

/// What was marked, row by row, in the order of time.
class MarkRows {
  public:
    void at(std::optional<double> seconds) { seconds_ = seconds; }
    void add(const interaction::Commands& commands) {
        instant_ = commands.instant.value_or(instant_);
        instant_.fraction = commands.fraction.value_or(instant_.fraction);
        for (const interaction::ToolRow& tool : interaction::tool_table())
            for (const interaction::MarkedRow& row :
                 tool.rows ? tool.rows(commands, known_) : std::vector<interaction::MarkedRow>())
                push(tool.makes, row, row.name);
        if (commands.bookmarks)
            add(*commands.bookmarks);
        if (commands.marks)
            add(*commands.marks);
        for (const std::string& stamp : commands.stamps)
            push("stamp", instant_, stamp);
        const auto keep = [](const interaction::Field&, const auto& given, auto& kept) {
            kept = given.value_or(kept);
        };
        interaction::each_setting(keep, commands, known_);
    }
    Table table() && {
        return {{"what", "seconds", "step", "fraction", "name", "x", "y", "z", "value"},
                std::move(rows_)};
    }

  private:
    void add(const std::vector<interaction::Bookmark>& all) {
        for (const interaction::Bookmark& each : all)
            if (std::ranges::find(known_.bookmarks, each) == known_.bookmarks.end())
                push("bookmark", each.instant, each.name);
    }
    void add(const std::vector<interaction::NamedMark>& all) {
        for (const interaction::NamedMark& each : all) {
            const interaction::MarkedPoint& point = each.point;
            const bool known =
                std::ranges::any_of(known_.marks, [&](const interaction::NamedMark& other) {
                    return other.name == each.name && other.point.position == point.position &&
                           other.point.instant == point.instant;
                });
            if (!known)
                push("mark", {point.position, point.value, point.instant}, each.name);
        }
    }
    Json& push(std::string_view what, index::Instant at, const std::string& name) {
        Json row{
            {"what", what},    {"seconds", nullptr}, {"step", at.step}, {"fraction", at.fraction},
            {"name", name},    {"x", nullptr},       {"y", nullptr},    {"z", nullptr},
            {"value", nullptr}};
        if (seconds_)
            row["seconds"] = *seconds_;
        rows_.push_back(std::move(row));
        return rows_.back();
    }
    void push(std::string_view what, const interaction::MarkedRow& made, const std::string& name) {
        Json& row = push(what, made.at.value_or(instant_), name);
        row["x"] = made.position.x;
        row["y"] = made.position.y;
        row["z"] = made.position.z;
        if (made.value)
            row["value"] = *made.value;
    }

    std::optional<double> seconds_;
    index::Instant instant_;
    interaction::Settings known_;
    Json rows_ = Json::array();
};

/// The members of objects within objects, with the names of both: `asked.step`.
void flatten(const Json& value, const std::string& name, Json& row) {
    if (value.is_object()) {
        for (const auto& [key, member] : value.items())
            flatten(member, name.empty() ? key : name + "." + key, row);
    } else {
        row[name] = value;
    }
}

Json timing_rows(const fs::path& file) {
    std::ifstream in(file);
    Json report;
    try {
        report = Json::parse(in);
    } catch (const Json::exception& mistake) {
        throw index::Error("{}: not a timing report: {}", file.string(),
                           index::json_mistake(mistake));
    }
    if (!report.is_object() || !report.contains("rows") || !report["rows"].is_array())
        throw index::Error(
            "{}: expected a recording, a session or a timing report of `isochron replay --report`",
            file.string());
    Json rows = Json::array();
    for (const Json& each : report["rows"]) {
        Json row = Json::object();
        flatten(each, "", row);
        rows.push_back(std::move(row));
    }
    return rows;
}

Table table_of(const fs::path& file) {
    if (!std::ifstream(file))
        throw index::Error("{}: cannot be read", file.string());
    MarkRows marks;
    if (names_format(file, "isochron recording")) {
        const interaction::Recording recording = read_recording(file);
        marks.at(recording.frames.empty() ? 0.0 : recording.frames.front().input.time.count());
        marks.add(recording.header.start);
        for (const interaction::RecordedFrame& frame : recording.frames) {
            marks.at(frame.input.time.count());
            marks.add(frame.commands);
        }
        return std::move(marks).table();
    }
    if (names_format(file, "isochron session")) {
        marks.add(read_session(file).state);
        return std::move(marks).table();
    }
    return {{}, timing_rows(file)};
}

void run_table(const TableArguments& arguments) {
    const auto [columns, rows] = table_of(arguments.file);
    if (tells_json() && arguments.out.empty())
        return tell_result(rows);
    const SafeText text = tells_json()
                              ? SafeText::json(rows, 1)
                              : SafeText::lines(csv_of(rows, columns, arguments.keep_formulas));
    if (arguments.out.empty())
        return print_answer(text);
    guard_outputs({{arguments.out, OutputKind::surface}}, {{arguments.file}, nullptr},
                  arguments.force);
    index::write_file(arguments.out, text.str());
    tell_result({{"file", arguments.out.string()}, {"rows", rows.size()}});
    print_report("wrote {}: {} rows\n", arguments.out.string(), rows.size());
}

} // namespace

void add_table(Command& program) {
    auto arguments = std::make_shared<TableArguments>();
    Command command = program.subcommand(
        "table", "Print a table of what a session marked, or of the times of its frames.");
    command.examples({"isochron table walk.jsonl", "isochron table walk.jsonl --json"});
    command
        .option("file FILE", arguments->file,
                "Recording or session, whose marks, rulers, bookmarks and stamps become rows. Or a "
                "timing report (`replay --report`), whose frames become rows")
        .required();
    command.option("-o,--output,--out FILE", arguments->out,
                   "File to write (default: print the table)");
    command.flag("--force", arguments->force, "Replace a file that exists");
    command.flag(
        "--keep-formulas", arguments->keep_formulas,
        "In CSV, leave texts as they are that begin with = + - or @. Without this option a "
        "' is put before them, so that spreadsheets do not take them for formulas");
    std::string made;
    for (const interaction::ToolRow& tool : interaction::tool_table())
        if (tool.rows)
            made += fmt::format("{}, ", tool.makes);
    command.footer(
        "The table is CSV; with --json it is a list of objects, one for each row. A row of a "
        "session "
        "has these columns: what (" +
        made +
        "bookmark or stamp), seconds since the session began, step, fraction (how far towards the "
        "next step: 32768 is halfway), name, x y z (in the unit of the data), and value (at a "
        "mark; "
        "in the last row of a ruler its length, or its angle in degrees). A row of a timing report "
        "has the report's keys "
        "as "
        "columns, such as `asked.step`.");
    command.on_run([arguments] { run_table(*arguments); });
}

} // namespace isochron::app
