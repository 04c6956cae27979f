// Reads .pvx files; the only source that includes the XML library.
#include "app/config/pvx_file.h"

#include "app/config/config_problem.h"
#include "app/safe_text.h"
#include "index/error.h"
#include "index/system/input_file.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace isochron::app {
namespace {

using stereo::StereoMode;
using tinyxml2::XMLElement;

constexpr float kUsualSeparation = 0.065f; ///< [m] ParaView's default between the eyes
constexpr int kMostViewers = 64;
constexpr int kMostNode = 255;    ///< largest node number of a configuration
constexpr float kFarthest = 1e6f; ///< [m] largest coordinate in a configuration

/// ParaView's names of stereo modes. Its red-blue and anaglyph pictures are for the same glasses as
/// our red-cyan mode; `Interlaced` alternates rows, `Dresden` columns.
constexpr std::array<std::pair<std::string_view, StereoMode>, 9> kStereoTypes{{
    {"Crystal Eyes", StereoMode::quadbuffer},
    {"Red-Blue", StereoMode::anaglyph_red_cyan},
    {"Anaglyph", StereoMode::anaglyph_red_cyan},
    {"Interlaced", StereoMode::vertical_interlaced},
    {"Dresden", StereoMode::horizontal_interlaced},
    {"Checkerboard", StereoMode::checkerboard},
    {"SplitViewportHorizontal", StereoMode::side_by_side},
    {"Left", StereoMode::left},
    {"Right", StereoMode::right},
}};

class PvxReader {
  public:
    PvxReader(std::string file, const PvxOptions& options)
        : file_(std::move(file)), options_(options) {}

    PvxImport read(const std::string& text) {
        tinyxml2::XMLDocument document;
        if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
            throw ConfigError("{}:{}: not well-formed XML ({})", file_,
                              std::max(document.ErrorLineNum(), 1), document.ErrorName());
        const XMLElement* root = document.RootElement();
        if (!root || std::string_view(root->Name()) != "pvx")
            throw ConfigError(
                one_line(fmt::format("{}: expected <pvx>, got {}", file_,
                                     root ? fmt::format("<{}>", root->Name()) : "no element")));
        read_process(process_of(*root));
        return std::move(import_);
    }

  private:
    [[noreturn]] void fail(const XMLElement& element, const std::string& what) const {
        throw ConfigError(one_line(
            fmt::format("{}:{}: {}: {}", file_, element.GetLineNum(), element.Name(), what)));
    }
    void note(const XMLElement& element, const std::string& what) {
        import_.notes.push_back(
            one_line(fmt::format("{}:{}: {}", file_, element.GetLineNum(), what)));
    }

    /// The `Process` element of the server, else the last one; newer files have none.
    static const XMLElement& process_of(const XMLElement& root) {
        const XMLElement* chosen = &root;
        for (const XMLElement* each = root.FirstChildElement("Process"); each;
             each = each->NextSiblingElement("Process")) {
            chosen = each;
            if (each->Attribute("Type", "server"))
                break;
        }
        return *chosen;
    }

    std::vector<float> numbers(const XMLElement& element, const char* attribute,
                               std::size_t count) const {
        const char* value = element.Attribute(attribute);
        if (!value)
            fail(element, fmt::format("{} is missing", attribute));
        std::istringstream words(value);
        words.imbue(std::locale::classic());
        std::vector<float> found;
        for (float number; words >> number;)
            found.push_back(number);
        const bool finite = std::ranges::all_of(found, [](float n) { return std::isfinite(n); });
        if (!words.eof() || found.size() != count || !finite)
            fail(element, fmt::format("{}: expected {} {}, got '{}'", attribute, count,
                                      count == 1 ? "number" : "numbers", value));
        return found;
    }

    /// A corner in the room.
    glm::vec3 corner(const XMLElement& machine, const char* attribute) const {
        const std::vector<float> n = numbers(machine, attribute, 3);
        const glm::vec3 meters =
            options_.meters_per_unit * glm::vec3(n[0], n[1], n[2]) + options_.origin;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(meters[axis]) <= kFarthest))
                fail(machine, fmt::format("{}: expected corners within {} m, got {} m", attribute,
                                          kFarthest, meters[axis]));
        return meters;
    }

    float separation(const XMLElement& element, const char* attribute) const {
        const float meters = numbers(element, attribute, 1).front() * options_.meters_per_unit;
        if (meters < 0.0f || meters > interaction::kWidestEyes)
            fail(element, fmt::format("{}: expected 0 to {} m, got {} m", attribute,
                                      interaction::kWidestEyes, meters));
        return meters;
    }

    /// `<NAME Value="1"/>`, `<Option Name="NAME" Value="1"/>` or an attribute of the machine.
    bool flag(const XMLElement& process, const XMLElement& machine, const char* name,
              bool usual) const {
        bool value = usual;
        if (const XMLElement* element = process.FirstChildElement(name))
            value = element->BoolAttribute("Value", value);
        for (const XMLElement* option = process.FirstChildElement("Option"); option;
             option = option->NextSiblingElement("Option"))
            if (option->Attribute("Name", name))
                value = option->BoolAttribute("Value", value);
        return machine.BoolAttribute(name, value);
    }

    void read_process(const XMLElement& process) {
        if (const XMLElement* element = process.FirstChildElement("EyeSeparation"))
            eye_separation_ = separation(*element, "Value");
        import_.installation.windows.clear();
        for (const XMLElement* machine = process.FirstChildElement("Machine"); machine;
             machine = machine->NextSiblingElement("Machine")) {
            stereo::Window window = read_machine(process, *machine);
            window.node =
                std::min(static_cast<int>(import_.installation.windows.size()), kMostNode);
            import_.installation.windows.push_back(std::move(window));
        }
        if (import_.installation.windows.empty())
            fail(process, "it has no Machine");
        make_viewers(process);
    }

    stereo::Window read_machine(const XMLElement& process, const XMLElement& machine) {
        stereo::Window window;
        window.name = new_name(machine);
        read_geometry(machine, window);
        window.fullscreen = flag(process, machine, "FullScreen", false);
        window.border = flag(process, machine, "ShowBorders", false);
        if (!flag(process, machine, "UseOffAxisProjection", true))
            note(machine, fmt::format("{}: without UseOffAxisProjection in ParaView, here its "
                                      "corners are seen from where the head is",
                                      window.name));
        if (const char* environment = machine.Attribute("Environment"))
            note(machine, fmt::format("{}: Environment=\"{}\" is left to the shell that starts "
                                      "the program",
                                      window.name, environment));
        window.stereo = read_stereo(machine);
        stereo::Viewport& viewport = window.viewports.front();
        viewport.viewer = read_viewer(machine);
        viewport.screen = read_screen(machine, window.name);
        return window;
    }

    /// Makes a screen from three corners; files from before 2012 give UpperLeft as the third one. A
    /// machine without corners gets a desktop screen before its viewer.
    stereo::Screen read_screen(const XMLElement& machine, const std::string& name) {
        const auto has = [&](const char* corner) { return machine.Attribute(corner) != nullptr; };
        if (!has("LowerLeft") && !has("LowerRight") && !has("UpperRight") && !has("UpperLeft")) {
            note(machine, fmt::format("{}: no corners (LowerLeft, LowerRight, UpperRight): a "
                                      "window on a desktop, whose screen the head carries",
                                      name));
            return {.lower_left = {-0.9f, -0.5f, -1.2f},
                    .upper_left = {-0.9f, 0.5f, -1.2f},
                    .upper_right = {0.9f, 0.5f, -1.2f},
                    .carried_by_head = true,
                    .fit_aspect = true};
        }
        const glm::vec3 lower_left = corner(machine, "LowerLeft");
        const glm::vec3 lower_right = corner(machine, "LowerRight");
        if (has("UpperRight")) {
            const glm::vec3 upper_right = corner(machine, "UpperRight");
            return {lower_left, lower_left + (upper_right - lower_right), upper_right};
        }
        if (!has("UpperLeft"))
            fail(machine, "UpperRight is missing");
        const glm::vec3 upper_left = corner(machine, "UpperLeft");
        return {lower_left, upper_left, lower_right + (upper_left - lower_left)};
    }

    std::string new_name(const XMLElement& machine) {
        const char* given = machine.Attribute("Name");
        const std::string name =
            given && *given ? given : fmt::format("window {}", names_.size() + 1);
        std::string unused = name;
        for (int twin = 2; !names_.insert(unused).second; ++twin)
            unused = fmt::format("{} {}", name, twin);
        return unused;
    }

    /// `WIDTHxHEIGHT+X+Y`.
    void read_geometry(const XMLElement& machine, stereo::Window& window) const {
        const char* geometry = machine.Attribute("Geometry");
        if (!geometry)
            return;
        char x = 0;
        std::istringstream words(geometry);
        words >> window.size.x >> x >> window.size.y;
        if (!words.eof())
            words >> window.position.x >> window.position.y;
        const auto fits = [](int value, int low, int high) {
            return value >= low && value <= high;
        };
        if (words.fail() || !words.eof() || x != 'x' || !fits(window.size.x, 16, 16384) ||
            !fits(window.size.y, 16, 16384) || !fits(window.position.x, -65536, 65536) ||
            !fits(window.position.y, -65536, 65536))
            fail(machine,
                 fmt::format("Geometry: expected WIDTHxHEIGHT+X+Y in pixels, got '{}'", geometry));
    }

    StereoMode read_stereo(const XMLElement& machine) const {
        const char* word = machine.Attribute("StereoType");
        if (!word)
            return StereoMode::mono;
        const auto found = std::ranges::find(kStereoTypes, std::string_view(word),
                                             &std::pair<std::string_view, StereoMode>::first);
        if (found == kStereoTypes.end())
            fail(machine, fmt::format("StereoType: '{}' is not one of ParaView's", word));
        return found->second;
    }

    std::size_t read_viewer(const XMLElement& machine) {
        int id = 0;
        const tinyxml2::XMLError error = machine.QueryIntAttribute("ViewerId", &id);
        if (error == tinyxml2::XML_WRONG_ATTRIBUTE_TYPE || id < 0 || id >= kMostViewers)
            fail(machine, fmt::format("ViewerId: expected a number from 0 to {}, got '{}'",
                                      kMostViewers - 1, machine.Attribute("ViewerId")));
        separations_.emplace(id, eye_separation_);
        return static_cast<std::size_t>(id);
    }

    void make_viewers(const XMLElement& process) {
        if (const XMLElement* viewers = process.FirstChildElement("IndependentViewers"))
            for (const XMLElement* each = viewers->FirstChildElement("Viewer"); each;
                 each = each->NextSiblingElement("Viewer")) {
                const auto known = separations_.find(each->IntAttribute("Id", -1));
                if (known == separations_.end())
                    fail(*each, "Id: no Machine has this ViewerId");
                known->second = separation(*each, "EyeSeparation");
            }
        if (separations_.rbegin()->first + 1 != static_cast<int>(separations_.size()))
            fail(process, "ViewerIds are numbered from 0 without a gap");
        import_.installation.viewers.clear();
        for (const auto& [id, meters] : separations_)
            import_.installation.viewers.push_back(
                {.name = id == 0 ? "viewer" : fmt::format("viewer {}", id + 1),
                 .head = id == 0 ? "head" : fmt::format("head {}", id + 1),
                 .position = options_.origin,
                 .eye_separation = meters});
    }

    std::string file_;
    PvxOptions options_;
    PvxImport import_;
    float eye_separation_ = kUsualSeparation;
    std::set<std::string> names_;
    std::map<int, float> separations_; ///< [m] by viewer
};

} // namespace

PvxImport parse_pvx(const std::string& text, const std::string& name, const PvxOptions& options) {
    return PvxReader(name, options).read(text);
}

PvxImport read_pvx(const std::filesystem::path& path, const PvxOptions& options) {
    constexpr std::uint64_t kMostBytes = 16 << 20;
    std::string text;
    try {
        text = index::read_text(path, kMostBytes);
    } catch (const index::Error& error) {
        throw ConfigError(error.what());
    }
    return parse_pvx(text, path.string(), options);
}

} // namespace isochron::app
