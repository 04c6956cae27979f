// Saves and reads sessions.
#include "app/kept/session_file.h"

#include "app/kept/session_picture.h"
#include "index/json_mistake.h"

#include "index/system/input_file.h"
#include "index/system/new_file.h"
#include "index/system/user_folders.h"
#include "interaction/error.h"
#include "interaction/recording/commands_json.h"
#include "interaction/recording/json_values.h"

#include <fmt/format.h>

#include <limits>

namespace isochron::app {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "isochron session";
constexpr std::uint64_t kVersion = 1;
constexpr std::uint64_t kLargest = 1 << 22; ///< largest file [byte]

json place_json(const interaction::StandingPlace& head) {
    return {{"position", {head.position.x, head.position.y, head.position.z}},
            {"yaw", head.yaw},
            {"pitch", head.pitch}};
}

interaction::StandingPlace place_from(const json& value) {
    interaction::Members members(value, "head");
    interaction::StandingPlace head;
    const json& position = interaction::list(members.at("position"), "position", 3, 3);
    for (int i = 0; i < 3; ++i)
        head.position[i] =
            interaction::small_number(position[static_cast<std::size_t>(i)], "position");
    head.yaw = interaction::small_number(members.at("yaw"), "yaw");
    head.pitch = interaction::small_number(members.at("pitch"), "pitch");
    members.done({"position", "yaw", "pitch"});
    return head;
}

std::vector<interaction::Commands> arrays_from(const json& value) {
    std::vector<interaction::Commands> arrays;
    for (const json& one : interaction::list(value, "arrays", 0, index::kMostArrays)) {
        arrays.push_back(interaction::commands_from(one, "arrays"));
        const interaction::Commands& left = arrays.back();
        if (!left.array || !left.isosurfaces || !left.picked || !left.coloring)
            throw interaction::Error("arrays: expected array, isosurfaces, picked and coloring");
    }
    return arrays;
}

json arrays_json(const std::vector<interaction::Commands>& arrays) {
    json list = json::array();
    for (const interaction::Commands& left : arrays)
        list.push_back(interaction::commands_json(left));
    return list;
}

SavedSession session_from(const json& value) {
    interaction::Members members(value, "session");
    if (interaction::text(members.at("format"), "format") != kFormat)
        throw interaction::Error("not a session: expected format \"{}\"", kFormat);
    interaction::natural(members.at("version"), "version", kVersion);
    SavedSession saved;
    saved.program = interaction::text(members.at("program"), "program");
    saved.data = interaction::text(members.at("data"), "data");
    saved.data_hash = interaction::text(members.at("data_hash"), "data_hash");
    saved.state = interaction::commands_from(members.at("state"), "state");
    saved.head = place_from(members.at("head"));
    if (const json* arrays = members.find("arrays"))
        saved.arrays = arrays_from(*arrays);
    if (const json* looked = members.find("only_looked"))
        saved.only_looked = interaction::boolean(*looked, "only_looked");
    if (const json* reading = members.find("reading_number"))
        saved.reading = static_cast<std::uint32_t>(interaction::natural(
            *reading, "reading_number", std::numeric_limits<std::uint32_t>::max()));
    const auto words = [&](const char* key, std::string& text) {
        if (const json* member = members.find(key))
            text = interaction::text(*member, key);
    };
    words("name", saved.name);
    words("opened", saved.opened);
    words("picture", saved.picture);
    if (auto picture = from_base64(saved.picture))
        saved.picture = std::move(*picture);
    else
        throw interaction::Error("picture: expected base64");
    members.done({"format", "version", "program", "data", "data_hash", "state", "head", "arrays",
                  "only_looked", "reading_number", "name", "opened", "picture"});
    return saved;
}

} // namespace

bool is_lasting(const SavedSession& session) {
    const interaction::Commands& state = session.state;
    return !session.name.empty() || (state.mark && state.mark->point) ||
           (state.rulers && !state.rulers->list.empty()) ||
           (state.bookmarks && !state.bookmarks->empty()) || (state.keys && !state.keys->empty());
}

void save_session(const std::filesystem::path& path, const SavedSession& session) {
    json value{{"format", kFormat},
               {"version", kVersion},
               {"program", session.program},
               {"data", session.data},
               {"data_hash", session.data_hash},
               {"state", interaction::commands_json(session.state)},
               {"head", place_json(session.head)}};
    if (!session.arrays.empty())
        value["arrays"] = arrays_json(session.arrays);
    if (session.only_looked)
        value["only_looked"] = true;
    if (session.reading != 0)
        value["reading_number"] = session.reading;
    if (!session.name.empty())
        value["name"] = session.name;
    if (!session.opened.empty())
        value["opened"] = session.opened;
    if (!session.picture.empty())
        value["picture"] = to_base64(session.picture);
    const std::string text = value.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
    index::write_file(path, text);
}

bool is_session_text(const std::string& text) {
    const json value = json::parse(text, nullptr, false);
    const auto format = value.is_object() ? value.find("format") : value.end();
    return value.is_object() && format != value.end() && *format == kFormat;
}

SavedSession session_in(const std::string& text, const std::string& name) {
    try {
        return session_from(json::parse(text));
    } catch (const json::exception& mistake) {
        throw interaction::Error("{}: not a session: {}", name, index::json_mistake(mistake));
    } catch (const interaction::Error& mistake) {
        throw interaction::Error("{}: {}", name, mistake.what());
    }
}

SavedSession read_session(const std::filesystem::path& path) {
    return session_in(index::read_text(path, kLargest), path.string());
}

ExplorerState state_of(const SavedSession& saved, const ExplorerState& fallback,
                       const std::string& data_hash, std::size_t steps, const std::string& name) {
    if (saved.data_hash != data_hash)
        throw interaction::Error("{}: a session on other data: expected hash {}, got {}", name,
                                 data_hash, saved.data_hash);
    ExplorerState state = fallback;
    if (!state.resume(saved.state, steps))
        throw interaction::Error("{}: what it holds does not fit the data ({} steps)", name, steps);
    for (const interaction::Commands& left : saved.arrays)
        if (ExplorerState trial = state; !trial.apply(left, steps))
            throw interaction::Error("{}: how it left array {} does not fit the data", name,
                                     *left.array);
    state.leaving = false;
    state.exporting = {};
    return state;
}

std::optional<std::filesystem::path> session_path(const std::filesystem::path& data,
                                                  const std::string& data_hash) {
    const std::optional<std::filesystem::path> folder = index::user_state_folder();
    if (!folder)
        return std::nullopt;
    return *folder / fmt::format("{}-{}.isochron-session", data.stem().string(), data_hash);
}

} // namespace isochron::app
