// Draws the panels of a figure, and lays out its page.
#include "app/explore/figure_page.h"

#include "app/config/first_placement.h"
#include "app/explore/explore_start.h"
#include "app/explore/kept_session.h"
#include "app/explore/replay_source.h"
#include "app/explore/series_movie.h"
#include "app/indexing/open_index.h"
#include "app/loop/replay.h"
#include "app/output/picture_note.h"
#include "app/output/picture_parts.h"
#include "app/scene/axes.h"
#include "app/scene/axis_labels.h"
#include "app/scene/caption.h"
#include "app/scene/font.h"
#include "app/scene/legend.h"
#include "app/scene/orientation.h"
#include "app/scene/ticks.h"
#include "app/session/session.h"
#include "app/text.h"
#include "app/version.h"
#include "index/error.h"
#include "index/system/input_file.h"
#include "interaction/error.h"
#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/navigation.h"
#include "render/gl/srgb.h"
#include "render/passes/line_pass.h"
#include "stereo/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ranges>
#include <utility>

namespace isochron::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPassesOfFigure = 4; ///< pictures of other samples, whose mean a panel is
constexpr double kHairline = 0.5;  ///< [pt]
constexpr double kLetterSize = 1.25, kLeading = 1.3; ///< in sizes of the letters

/// What a panel shows, with the words around it; places in shares of the picture, from its upper left.
struct DrawnPanel {
    render::Image image;
    std::vector<PageText> labels;         ///< `at` as above
    std::vector<PageLine> behind, before; ///< the box, with its ticks
    std::optional<ScaleBar> bar;          ///< its pixels are those of the picture
    std::string length_unit, title;
    std::optional<ColorScale> scale;
    bool by_values = false; ///< surfaces of all arrays have the colors of the scale
    std::vector<interaction::Isosurface> surfaces;
    std::vector<LegendLine> ghosts;         ///< by time
    std::vector<std::string> surface_words; ///< their isovalues, and arrays if these are other ones
    std::string drawn_with, data_hash;
};

/// The view of a panel, turned and enlarged about the middle of the data.
interaction::Similarity view_of_panel(const FigurePanel& panel, interaction::Similarity view,
                                      const glm::dvec3& middle) {
    const glm::dvec3 center = transform(view, middle);
    view = interaction::turned(view, center, view.rotation * glm::dvec3(0, 0, 1), panel.turn);
    view = interaction::turned(view, center, {1, 0, 0}, panel.tilt);
    return interaction::scaled(view, center, panel.zoom, 0, std::numeric_limits<double>::max());
}

class PanelDrawing {
  public:
    PanelDrawing(const FigurePanel& panel, const fs::path& name, const fs::path& data)
        : panel_(panel), where_(fmt::format("{}:{}", name.string(), panel.line)), data_(data) {}

    /// @param pixels size of the picture @param text height of a line of text, pixels
    DrawnPanel draw(glm::ivec2 pixels, double text, double points, double dpi,
                    stereo::ContextKind context) const {
        Config config = read_config("desktop");
        config.rendering.context = context;
        config.pictures.passes = kPassesOfFigure;
        config.pictures.background = interaction::WrittenBackground::transparent;
        config.pictures.dpi = dpi;
        config.pictures.text = static_cast<float>(text / pixels.y);
        config.installation.windows.front().size = pixels;
        const auto file = open_index_to_show(data_, config.memory.cache_bytes());
        Session session(config, file, stereo::open_windows(context, config.installation, {}));
        session.set_data_name(data_.filename().string());
        session.models().add_folder(std::filesystem::path(where_).parent_path());
        session.set_state(state_for(session, config, *file));
        settle(session);
        say_faults(session.models());
        return drawn(session, *file, pixels, text, points);
    }

  private:
    ExplorerState state_for(const Session& session, const Config& config,
                            const index::IndexFile& file) const {
        const std::size_t steps = file.info().steps();
        ExplorerState state = session.state();
        fill_picture(session, config, file.info(), state);
        const std::size_t first = first_array(file);
        if (first > 0)
            state.apply(session.way_to_array(first), steps);
        if (!config.between)
            state.between = advised_between(file.array(first));
        const auto expect_fits = [&](const interaction::Commands& commands, const char* what) {
            std::vector<std::string> refused = state.refusals(commands, steps);
            if (commands.array)
                try {
                    session.expect_array(*commands.array);
                } catch (const index::Error& error) {
                    refused.emplace_back(error.what());
                }
            if (!refused.empty())
                throw interaction::Error("{}: {} does not fit {}: {}", where_, what, data_.string(),
                                         fmt::join(refused, "; "));
        };
        if (panel_.state) {
            expect_fits(*panel_.state, "the session");
            state.resume(*panel_.state, steps);
        }
        // Another array comes with isovalues of its own, which the panel may say otherwise.
        if (const auto array = file.array_called(panel_.key.array.value_or(state.array));
            panel_.key.array && array && *panel_.key.array != state.array)
            state.apply(session.way_to_array(*array), steps);
        interaction::Settings shown = state;
        interaction::show_key(panel_.key, shown);
        const interaction::Commands way = interaction::changes(state, shown);
        expect_fits(way, "the panel");
        state.apply(way, steps);
        state.room_from_physical =
            view_of_panel(panel_, state.room_from_physical, physical_center(file.info().grid));
        state.bounding_box = state.grid = false; // the page has the box
        state.panel = false;
        state.room_panel = {};
        state.keys.clear();
        state.playback = {};
        state.quality = interaction::QualityMode::quality;
        state.set_stereo(stereo::StereoMode::mono);
        state.pictures = {};
        state.pictures.legend = state.pictures.scale_bar = state.pictures.caption = false;
        return state;
    }

    /// Draws with the devices at rest until the picture is as good as it gets.
    void settle(Session& session) const {
        constexpr int kMost = 100;
        interaction::InputState input;
        if (panel_.key.head) {
            interaction::DeviceState& head = input.devices.emplace_back();
            head.name = "head";
            head.pose = panel_.key.head;
        }
        for (int i = 0; i < kMost; ++i) {
            const FrameReport& frame = session.frame(input, {}, Waiting::for_cells);
            expect_cells(session);
            if (frame.final && !frame.redrawn)
                return;
            input.time += interaction::Seconds(0.1);
        }
    }

    DrawnPanel drawn(Session& session, const index::IndexFile& file, glm::ivec2 pixels, double text,
                     double points) const {
        DrawnPanel drawn;
        const PictureNote note = session.note();
        const PictureNames names{{PictureNames::Window{"", {""}}}};
        each_part(session.outputs(), false, names, note,
                  [&](const PictureNote& mine, const std::string&, render::Image image) {
                      drawn.image = std::move(image);
                      drawn.drawn_with = mine.drawn_with;
                  });
        const ExplorerState& state = session.state();
        const std::size_t array = file.array_called(state.array).value_or(0);
        const index::SeriesInfo& info = file.array(array).info();
        const auto& viewers = session.outputs().audience().viewers;
        const std::vector<render::View> views =
            session.outputs().display().views_in_window(viewers);
        drawn.data_hash = note.data_hash;
        drawn.surfaces = state.isosurfaces;
        drawn.ghosts = session.ghost_lines();
        drawn.scale = session.scale();
        drawn.by_values = state.coloring.by != interaction::ColorBy::surface;
        drawn.length_unit = info.length_unit;
        for (std::size_t i = 0; i < state.isosurfaces.size(); ++i) {
            const interaction::Isosurface& surface = state.isosurfaces[i];
            const index::SeriesInfo& own = file.array(array_of_surface(state, i, file)).info();
            drawn.surface_words.push_back((surface.of_shown_array() ? "" : own.array + " ") +
                                          with_unit(surface.isovalue, own.value_unit, own.digits));
        }
        drawn.bar = scale_bar(views.front(), state.room_from_physical, physical_center(info.grid));
        const auto further = words_of(shown_further(session.further().shown(), state, file));
        drawn.title = panel_.title.value_or(caption_text(state.surfaces(), info, further));
        if (panel_.axes)
            add_box(drawn, info, state, viewers.front().head, views, pixels, text, points);
        return drawn;
    }

    static void add_box(DrawnPanel& drawn, const index::SeriesInfo& info,
                        const ExplorerState& state, const interaction::Pose& head,
                        const std::vector<render::View>& views, glm::ivec2 pixels, double text,
                        double points) {
        const auto placement = render::Placement::of(info.grid, matrix(state.room_from_physical));
        const Axes axes = axes_for(info, placement, head, views);
        const auto share = static_cast<float>(text / pixels.y);
        const render::View& view = views.front();
        const glm::mat4 clip = view.clip_from_eye * view.eye_from_room * placement.room_from_index;
        const glm::vec3 eye(glm::inverse(placement.room_from_index) *
                            glm::vec4(view.eye_in_room(), 1.0f));
        const render::BoxLines box = render::box_lines(placement.extent, glm::vec4(1), eye);
        const auto add_lines = [&](const std::vector<render::Line>& lines, double gray,
                                   std::vector<PageLine>& to) {
            for (const render::Line& line : lines) {
                const glm::vec4 from = clip * glm::vec4(line.from, 1.0f),
                                end = clip * glm::vec4(line.to, 1.0f);
                if (from.w > 0 && end.w > 0)
                    to.push_back({.from = in_picture(from),
                                  .to = in_picture(end),
                                  .points = kHairline,
                                  .color = glm::dvec3(gray)});
            }
        };
        constexpr double kBackEdge = 0.7, kEdge = 0.35, kTick = 0.0;
        add_lines(box.back, kBackEdge, drawn.behind);
        add_lines(box.outline, kEdge, drawn.before);
        add_lines(box.front, kEdge, drawn.before);
        add_lines(axes.ticks, kTick, drawn.before);
        for (const render::Label& label :
             labels_with_room(axes.labels, room_font(static_cast<int>(std::lround(text))),
                              placement, views, share)) {
            const glm::dvec2 place = in_picture(clip * glm::vec4(label.at, 1.0f));
            const glm::dvec2 offset = glm::dvec2(label.offset) *
                                      static_cast<double>(text_height(pixels, share)) /
                                      glm::dvec2(pixels);
            drawn.labels.push_back({.at = {place.x + offset.x, place.y - offset.y},
                                    .text = label.text,
                                    .points = points,
                                    .anchor = glm::dvec2(label.anchor)});
        }
    }

    /// Shares of the picture, from its upper left.
    static glm::dvec2 in_picture(const glm::dvec4& clip) {
        return {0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w};
    }

    const FigurePanel& panel_;
    const std::string where_;
    const fs::path data_;
};

/// Lays out panels in rows, and the caption below.
class FigureLayout {
  public:
    FigureLayout(const FigureFile& figure, const fs::path& name, const std::vector<fs::path>& data,
                 stereo::ContextKind context)
        : figure_(figure), name_(name), data_(data), context_(context),
          size_(figure.font_size / kPointsOfMillimeter) {
        made_.record.program = kProgram;
        made_.record.text = figure.text;
        made_.record.texts = figure.texts;
        made_.data = data;
    }

    MadeFigure make() && {
        const double columns = static_cast<double>(figure_.columns);
        const double cell =
            (figure_.width - 2 * figure_.margin - (columns - 1) * figure_.gap) / columns;
        if (cell < 4 * size_)
            throw interaction::Error("{}: width: expected room for {} columns, got {:g} mm",
                                     name_.string(), figure_.columns, figure_.width);
        double y = figure_.margin, row = 0;
        for (std::size_t i = 0; i < figure_.panels.size(); ++i) {
            const std::size_t column = i % figure_.columns;
            if (i > 0 && column == 0) {
                y += row + figure_.gap;
                row = 0;
            }
            const double x = figure_.margin + static_cast<double>(column) * (cell + figure_.gap);
            row = std::max(row, add_panel(i, {x, y}, cell));
        }
        y += row;
        made_.page.size = {figure_.width, add_caption(y) + figure_.margin};
        made_.page.note = text_of(made_.record);
        return std::move(made_);
    }

  private:
    double line_height() const { return kLeading * size_; }
    Page& page() { return made_.page; }
    double width_of(const std::string& text) const {
        return width_of_text(text, figure_.font_size, false);
    }

    /// A text in lines no wider than that.
    std::vector<std::string> wrapped(const std::string& text, double width) const {
        std::vector<std::string> lines{""};
        std::size_t at = 0;
        while (at < text.size()) {
            const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
            const std::string word = text.substr(at, end - at);
            std::string& line = lines.back();
            const std::string longer = line.empty() ? word : line + ' ' + word;
            if (line.empty() || width_of(longer) <= width)
                line = longer;
            else
                lines.push_back(word);
            if (end < text.size() && text[end] == '\n')
                lines.emplace_back();
            at = end + 1;
        }
        return lines;
    }
    /// @return the place below
    double add_lines(const std::string& text, glm::dvec2 at, double width) {
        for (const std::string& line : wrapped(text, width)) {
            at.y += line_height();
            page().texts.push_back({.at = at, .text = line, .points = figure_.font_size});
        }
        return at.y;
    }

    std::string letter(std::size_t panel) const {
        if (figure_.letters == "none" || figure_.panels.size() == 1)
            return "";
        const std::string letter(1,
                                 static_cast<char>((figure_.letters == "A" ? 'A' : 'a') + panel));
        return figure_.letters == "(a)" ? "(" + letter + ")" : letter;
    }

    /// What the legend takes beside the picture [mm].
    struct LegendRoom {
        std::vector<ScaleTick> ticks{};
        struct Line {
            std::string words;
            std::optional<glm::vec3> color; ///< none: the scale has the colors
        };
        std::vector<Line> lines{}; ///< surfaces, then ghosts, the latest first
        double width = 0;
    };
    LegendRoom legend_of(const FigurePanel& panel, const DrawnPanel& drawn) const {
        LegendRoom room;
        if (!panel.legend)
            return room;
        double widest = 0;
        if (drawn.scale) {
            constexpr int kMostTicksOfBar = 6;
            room.ticks = ticks_on(*drawn.scale, kMostTicksOfBar);
            for (const ScaleTick& tick : room.ticks)
                widest = std::max(widest, width_of(tick.words));
            widest = std::max(widest, width_of(drawn.scale->title) - 1.9 * size_);
        }
        if (drawn.surfaces.size() > 1)
            for (std::size_t i = 0; i < drawn.surfaces.size(); ++i) {
                const interaction::Isosurface& surface = drawn.surfaces[i];
                const bool on_scale = drawn.scale && (surface.of_shown_array() || drawn.by_values);
                room.lines.push_back({drawn.surface_words[i],
                                      on_scale ? std::nullopt : std::optional(surface.color)});
            }
        for (const LegendLine& ghost : drawn.ghosts | std::views::reverse)
            room.lines.push_back({ghost.words, ghost.color});
        for (const LegendRoom::Line& line : room.lines)
            widest = std::max(widest, width_of(line.words));
        if (!room.ticks.empty() || !room.lines.empty())
            room.width = widest + 3 * size_;
        return room;
    }

    /// @return its height
    double add_panel(std::size_t number, glm::dvec2 corner, double cell) {
        const FigurePanel& panel = figure_.panels[number];
        const PanelDrawing drawing(panel, name_, data_[number]);
        const auto pixels_for = [&](double width) {
            return glm::max(glm::ivec2(16),
                            glm::ivec2(glm::round(glm::dvec2(width, width * panel.aspect) *
                                                  figure_.dpi / 25.4)));
        };
        const double text = kLineOfText * figure_.font_size / 72 * figure_.dpi;
        // How much room the legend takes is known once the data are: from a small picture.
        const DrawnPanel first =
            drawing.draw(glm::ivec2(64, 64), 11, figure_.font_size, figure_.dpi, context_);
        const LegendRoom legend = legend_of(panel, first);
        const double width = cell - legend.width;
        if (width < 0.3 * cell)
            throw interaction::Error("{}:{}: the legend leaves the picture {:.3g} mm; expected a "
                                     "wider figure, smaller letters or legend = false",
                                     name_.string(), panel.line, width);
        DrawnPanel drawn =
            drawing.draw(pixels_for(width), text, figure_.font_size, figure_.dpi, context_);
        made_.record.drawn_with = drawn.drawn_with;
        made_.record.data.push_back(data_[number].filename().string());
        made_.record.hashes.push_back(drawn.data_hash);
        const double top = add_heading(number, drawn.title, corner, cell);
        const glm::dvec2 at(corner.x, top), size(width, width * panel.aspect);
        for (PageText& label : drawn.labels) {
            label.at = at + label.at * size;
            page().texts.push_back(label);
        }
        for (auto* const lines : {&drawn.behind, &drawn.before})
            for (PageLine& line : *lines) {
                line.from = at + line.from * size;
                line.to = at + line.to * size;
                (lines == &drawn.behind ? page().lines_behind : page().lines).push_back(line);
            }
        if (panel.scale_bar && drawn.bar)
            add_scale_bar(drawn, at, size);
        page().pictures.push_back({at, size, std::move(drawn.image)});
        if (legend.width > 0)
            add_legend(drawn, legend, {at.x + size.x + size_, at.y}, size.y);
        return top + size.y - corner.y;
    }

    /// @return the place below
    double add_heading(std::size_t number, const std::string& title, glm::dvec2 corner,
                       double cell) {
        const std::string letter_text = letter(number);
        double x = corner.x;
        const double baseline = corner.y + kLetterSize * size_;
        if (!letter_text.empty()) {
            const double points = kLetterSize * figure_.font_size;
            page().texts.push_back({.at = {x, baseline + kBelowBaseline * kLetterSize * size_},
                                    .text = letter_text,
                                    .points = points,
                                    .bold = true});
            x += width_of_text(letter_text, points, true) + 0.7 * size_;
        }
        if (title.empty())
            return letter_text.empty() ? corner.y : baseline + 0.6 * size_;
        double y = baseline;
        for (const std::string& line : wrapped(title, corner.x + cell - x)) {
            page().texts.push_back(
                {.at = {x, y + kBelowBaseline * size_}, .text = line, .points = figure_.font_size});
            y += line_height();
        }
        return y - line_height() + 0.6 * size_;
    }

    void add_scale_bar(const DrawnPanel& drawn, glm::dvec2 at, glm::dvec2 size) {
        const double length = drawn.bar->pixels * size.x / drawn.image.width;
        const glm::dvec2 left(at.x + 0.5 * size_, at.y + size.y - 0.6 * size_);
        page().lines.push_back({.from = left, .to = left + glm::dvec2(length, 0), .points = 1.5});
        page().texts.push_back(
            {.at = left + glm::dvec2(0.5 * length, -0.3 * size_),
             .text = human_number(drawn.bar->length) + with_space(drawn.length_unit),
             .points = figure_.font_size,
             .anchor = {0.5, 0}});
    }

    void add_legend(const DrawnPanel& drawn, const LegendRoom& legend, glm::dvec2 at,
                    double height) {
        const double bar = 1.1 * size_;
        double y = at.y;
        if (drawn.scale) {
            page().texts.push_back({.at = {at.x, y + line_height()},
                                    .text = drawn.scale->title,
                                    .points = figure_.font_size});
            y += line_height() + size_;
            const double used = static_cast<double>(legend.lines.size()) * line_height();
            const double high =
                std::clamp(height - 3.5 * line_height() - used, 3 * size_, 22 * size_);
            page().pictures.push_back({{at.x, y}, {bar, high}, bar_image(*drawn.scale)});
            outline({at.x, y}, {bar, high});
            for (const auto& [share, words] : legend.ticks) {
                const glm::dvec2 tick(at.x + bar, y + (1 - share) * high);
                page().lines.push_back(
                    {.from = tick, .to = tick + glm::dvec2(0.4 * size_, 0), .points = kHairline});
                page().texts.push_back({.at = tick + glm::dvec2(0.7 * size_, 0),
                                        .text = words,
                                        .points = figure_.font_size,
                                        .anchor = {0, 0.5}});
            }
            y += high + line_height();
        }
        for (const LegendRoom::Line& line : legend.lines) {
            if (line.color) {
                const glm::dvec2 patch(at.x, y + 0.15 * size_), side(bar, 0.9 * size_);
                page().areas.push_back({patch, side, glm::dvec3(*line.color)});
                outline(patch, side);
            }
            page().texts.push_back({.at = {at.x + bar + 0.7 * size_, y + 0.6 * size_},
                                    .text = line.words,
                                    .points = figure_.font_size,
                                    .anchor = {0, 0.5}});
            y += line_height();
        }
    }

    void outline(glm::dvec2 at, glm::dvec2 size) {
        const glm::dvec2 right(size.x, 0), down(0, size.y);
        for (const auto& [from, to] : {std::pair(at, at + right), std::pair(at + right, at + size),
                                       std::pair(at + size, at + down), std::pair(at + down, at)})
            page().lines.push_back({.from = from, .to = to, .points = kHairline});
    }

    static render::Image bar_image(const ColorScale& scale) {
        constexpr int kRows = 256;
        const std::vector<glm::vec3> colors = colors_of(scale);
        render::Image image{1, kRows, {}};
        for (int row = 0; row < kRows; ++row) {
            const std::size_t at =
                static_cast<std::size_t>(kRows - 1 - row) * (colors.size() - 1) / (kRows - 1);
            const glm::vec3 color = render::srgb_from_linear(colors[at]);
            for (int c = 0; c < 3; ++c)
                image.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * color[c])));
            image.rgba.push_back(255);
        }
        return image;
    }

    double add_caption(double y) {
        if (figure_.caption.empty())
            return y;
        return add_lines(figure_.caption, {figure_.margin, y + 0.5 * figure_.gap},
                         figure_.width - 2 * figure_.margin) +
               kBelowBaseline * size_;
    }

    const FigureFile& figure_;
    const fs::path name_;
    const std::vector<fs::path>& data_;
    const stereo::ContextKind context_;
    const double size_; ///< [mm] of the letters
    MadeFigure made_;
};

} // namespace

std::string text_of(const FigureRecord& record) {
    return json{{"format", kFigureFormat},   {"version", 1},
                {"program", record.program}, {"drawn_with", record.drawn_with},
                {"figure", record.text},     {"files", record.texts},
                {"data", record.data},       {"data_hashes", record.hashes}}
        .dump(-1, ' ', true, json::error_handler_t::replace);
}

FigureRecord figure_record_from(const std::string& text) {
    try {
        const json value = json::parse(text);
        if (value.at("format") != kFigureFormat || value.at("version") != 1)
            throw interaction::Error("not a figure of this program, or of a later one");
        return {value.at("program"), value.at("drawn_with"), value.at("figure"),
                value.at("files"),   value.at("data"),       value.at("data_hashes")};
    } catch (const json::exception&) {
        throw interaction::Error("what it says of itself is damaged");
    }
}

MadeFigure make_figure(const FigureFile& figure, const fs::path& name,
                       const std::vector<fs::path>& data, stereo::ContextKind context) {
    return FigureLayout(figure, name, data, context).make();
}

std::vector<std::byte> figure_bytes(const MadeFigure& made, double dpi, const fs::path& file) {
    if (file.extension() == ".pdf")
        return pdf_of(made.page, file);
    return stereo::encoded_image(pixels_of(made.page, dpi, file), file, made.page.note);
}

} // namespace isochron::app
