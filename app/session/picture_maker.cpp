// Makes the picture of a frame.
#include "app/session/picture_maker.h"

#include "app/scene/caption.h"
#include "app/scene/mark.h"
#include "app/scene/overlay_colors.h"
#include "app/text.h"
#include "interaction/input/device_reading.h"
#include "interaction/navigation/navigation.h"
#include "interaction/navigation/navigator.h"
#include "interaction/navigation/story.h"
#include "interaction/tools/clip_box.h"
#include "interaction/tools/tool_table.h"

#include <glm/geometric.hpp>

namespace isochron::app {
namespace {

/// Whether a place is the mark's, as far as the viewer can tell the two apart.
bool is_marked(const interaction::Pointed& pointed, const interaction::Pose& viewer,
               const ExplorerState& state) {
    constexpr double kApart = 0.012; // [rad] some pixels more than the arms of the mark
    const auto& mark = state.mark.point;
    if (!mark || !mark->shown || mark->instant != pointed.point.instant)
        return false;
    const auto way = [&](const interaction::MarkedPoint& point) {
        return glm::normalize(transform(state.room_from_physical, point.position) -
                              glm::dvec3(viewer.position));
    };
    return glm::distance(way(*mark), way(pointed.point)) < kApart;
}

/// What stands beside the place of the story's step: its text, except where a card over the picture
/// has that.
std::optional<ToldPlace> told_place(const ExplorerState& state, bool beside_card) {
    constexpr std::size_t kColumns = 44, kMostLines = 12;
    const interaction::KeyFrame* const key = interaction::told_key(state);
    if (!key || !key->place)
        return std::nullopt;
    ToldPlace told{*key->place, {interaction::story_heading(state.keys, state.story)}};
    if (!beside_card)
        for (std::string& line : wrapped(
                 key->text, [](const std::string& line) { return characters_of(line) <= kColumns; },
                 kMostLines))
            told.lines.push_back(std::move(line));
    return told;
}

} // namespace

std::vector<stereo::ViewerPose> PictureMaker::viewers(const interaction::InputState& input,
                                                      const ExplorerState& state) const {
    std::optional<glm::dvec3> center; // center of the data in the room, in parallel projection
    if (state.orthographic)
        center = interaction::transform(state.room_from_physical,
                                        physical_center(arrays_.file()->info().grid));
    return viewer_poses(config_.installation, input, state.eye_separation, center);
}

/// Whether the drawn cells have the current coloring. Before that, their color coordinates have
/// another meaning.
bool PictureMaker::colored_as_asked(const ExplorerState& state) const {
    const index::ExtractionPtr& shown = sets_.shown();
    const index::SurfacesQuery wanted = arrays_.surfaces(state);
    return shown && shown->query.coloring == wanted.coloring &&
           shown->query.colors == wanted.colors && shown->query.array == wanted.array;
}

std::optional<ColorScale> PictureMaker::scale(const ExplorerState& state) const {
    ColoredSurfaces shown;
    if (colored_as_asked(state))
        shown.cells = sets_.shown();
    for (const index::InstantSurfacesPtr& each : further_.shown())
        if (app::colored_as_asked(*each, state, *arrays_.file()))
            shown.further.push_back(each);
    return color_scale(state, *arrays_.file(), shown, percentiles_);
}

/// The color scale of the drawn cells. Empty until these have the current coloring.
std::optional<ColorScale> PictureMaker::shown_scale(const ExplorerState& state) const {
    return colored_as_asked(state) ? scale(state) : std::nullopt;
}

/// Whether the windows show the scene themselves: always without a headset; beside a headset only
/// after it has wanted no picture for a moment.
bool PictureMaker::in_windows(const FrameReport& report) {
    constexpr interaction::Seconds kMoment{0.5};
    if (!outputs_.headset_eyes().empty())
        in_headset_ = report.time;
    return !in_headset_ || report.time - *in_headset_ > kMoment;
}

bool PictureMaker::on_desktop(const Audience& audience) const {
    return outputs_.windows().first().has_window() && outputs_.shows_windows(audience) &&
           on_screens_of_desk();
}

bool PictureMaker::on_screens_of_desk() const {
    const auto& screens = config_.installation.windows.front().viewports;
    return !outputs_.room() && screens.front().screen.fit_aspect;
}

/// Whether a window shows a lighter background than the one that was asked for, as the dark end of the
/// color map would vanish on that.
bool PictureMaker::lifts_background(const Frame& frame, const Audience& audience) const {
    const interaction::Look& look = frame.state.look;
    if (!frame.is_live() || !look.lifts || look.background != interaction::Background::dark ||
        !on_desktop(audience))
        return false;
    const auto colors = scale(frame.state);
    return colors && wants_lifting(colors_of(*colors), config_.rendering.background);
}

/// At a desk the words of the picture are as high as those of the panel.
float PictureMaker::text_share(const ExplorerState& state) const {
    if (!on_screens_of_desk())
        return 0.0f;
    return outputs_.windows().first().has_window() ? panel_.text_share(state)
                                                   : config_.pictures.text;
}

/// The ray of a wand that mouse and keyboard play shows nothing that the cursor does not show.
/// What the cursor points at has no words while a button is down, and none where the mark has them.
Aids PictureMaker::aids(const interaction::InputState& input, const ExplorerState& state) const {
    const interaction::Reading now(input);
    const bool aims = !panel_.in_room().touched() && interaction::Reading::buttons(now.mouse) == 0;
    const bool points = !panel_.head_is_emulated();
    const interaction::DeviceState* wand =
        config_.rendering.wand_ray && points ? input.find("wand") : nullptr;
    auto pointed = picker_.pointed(input, aims, state, sets_.shown());
    if (pointed && is_marked(*pointed, now.viewer(), state))
        pointed.reset();
    return {wand ? wand->pose : std::nullopt, pointed};
}

/// At a desktop often nothing but the cursor moves: the picture below the cursor stays as it is.
bool PictureMaker::aids_lie_over(const ExplorerState& state) const {
    const bool one_picture_each =
        !stereo::Multiplex::shows(state.stereo_mode()) &&
        stereo::upright(state.stereo_mode()) != stereo::StereoMode::quadbuffer;
    return panel_.head_is_emulated() && !outputs_.room() && !config_.pictures.ray &&
           outputs_.displays() == 1 && one_picture_each;
}

ShownValues PictureMaker::shown_values(const ExplorerState& state) const {
    const index::SeriesInfo& info = arrays_.shown(state).info();
    return {info.array, info.value_unit, info.type, info.digits};
}

Picture PictureMaker::make(const Frame& frame, const interaction::InputState& seen) {
    const ExplorerState& state = frame.state;
    const Aids all = aids(seen, state), none;
    const bool over = aids_lie_over(state);
    const Aids& within = over ? none : all;
    over_ = over ? all : none;
    Picture picture{
        .audience = {.viewers = viewers(seen, state),
                     .eyes = outputs_.headset_eyes(),
                     .wand = within.wand,
                     .panel = panel_.in_room().shown(state.room_panel),
                     .stereo = state.stereo_mode(),
                     .aids = within.wand || within.pointed,
                     .in_windows = in_windows(frame.report)},
        .mark = state.mark,
        .marks = state.marks,
        .pointed = within.pointed,
        .told = title_.words.empty()
                    ? told_place(state, on_screens_of_desk() && !outputs_.headset())
                    : std::nullopt,
        .tools = drawing_of(state, data_frame(frame.file.info())),
        .cuts = cutting_planes(state, data_frame(frame.file.info())),
        .guides = {state.grid, interaction::teleport_target(seen)},
        .veil = {static_cast<float>(frame.report.comfort.fade),
                 static_cast<float>(frame.report.comfort.vignette)},
        .room_from_physical = state.room_from_physical,
        .footprint = frame.drawn ? frame.drawn->footprint : render::Footprint{},
        .resolution = frame.drawn ? frame.drawn->resolution : 0,
        .cells = sets_.shown(),
        .isosurfaces = state.isosurfaces,
        .values = shown_values(state),
        .surfaces = !state.slices.hides_surfaces(),
        .slices = shown_slices(slices_.shown(), state, frame.file),
        .beside = models_.shown(state),
        .ghosts =
            shown_ghosts(ghosts_.shown(), state,
                         sets_.shown() ? sets_.shown()->query.instant : frame.report.asked.instant),
        .further = shown_further(further_.shown(), state, *arrays_.file()),
        .look = state.look,
        .scale = shown_scale(state),
        .bounding_box = state.bounding_box,
        .orientation = false,
        .caption = {},
        .title = title_,
        .mesh_level = frame.drawn ? frame.drawn->mesh_level : 0,
        .moved = frame.drawn && frame.drawn->moved,
        .layout = {.windows = outputs_.window_sizes(),
                   .free = panel_.covered(state),
                   .aside = panel_.stands_beside(interaction::Reading(seen).viewer(), state)
                                ? SessionPanel::kShare
                                : 0.0f,
                   .text = text_share(state),
                   .corners = panel_.corners(state)}};
    for (interaction::Isosurface& surface : picture.isosurfaces)
        if (!surface.of_shown_array())
            surface.isovalue = 0; // `further` has what is drawn
    picture.orientation = on_desktop(picture.audience) && !state.room_panel.shown;
    picture.audience.lifted = lifts_background(frame, picture.audience);
    if (picture.audience.lifted)
        picture.look.background = interaction::Background::gray;
    return picture;
}

Picture PictureMaker::first(const ExplorerState& state) const {
    Picture picture;
    picture.audience.viewers = viewers({}, state);
    picture.audience.stereo = state.stereo_mode();
    picture.mark = state.mark;
    picture.room_from_physical = state.room_from_physical;
    picture.isosurfaces = state.isosurfaces;
    picture.values = shown_values(state);
    picture.look = state.look;
    picture.bounding_box = state.bounding_box;
    return picture;
}

void PictureMaker::show_cells(Picture& picture, const ExplorerState& state) const {
    picture.cells = sets_.shown();
    picture.scale = shown_scale(state);
}

std::optional<interaction::Pointed> PictureMaker::pointed(const interaction::InputState& input,
                                                          const ExplorerState& state) const {
    return picker_.pointed(input, !panel_.in_room().touched(), state, sets_.shown());
}

std::string PictureMaker::words_under_pointer(const interaction::InputState& input,
                                              const ExplorerState& state) const {
    const auto at = pointed(input, state);
    if (!at && !state.mark.point)
        return "";
    return mark_text(at ? at->point : *state.mark.point, arrays_.shown(state).info());
}

interaction::WrittenPictures
PictureMaker::written(const interaction::WrittenPictures& asked) const {
    interaction::WrittenPictures written = asked;
    if (config_.pictures.background != interaction::WrittenBackground::shown)
        written.background = config_.pictures.background;
    if (config_.pictures.dpi > 0)
        written.dpi = config_.pictures.dpi;
    return written;
}

Picture PictureMaker::kept(const Picture& picture,
                           const interaction::WrittenPictures& asked) const {
    using interaction::WrittenBackground;
    const interaction::WrittenPictures parts = written(asked);
    Picture kept = picture;
    kept.moved = false;
    if (picture.audience.lifted)
        kept.look.background = interaction::Background::dark;
    kept.audience.lifted = false;
    if (!config_.pictures.ray) {
        kept.pointed.reset();
        kept.audience.wand.reset();
    }
    kept.layout.corners = {}; // the panel is not in it
    kept.legend = parts.legend;
    kept.bounding_box &= parts.box;
    // Also where no window is, so that a picture is made again as it was.
    kept.orientation = config_.pictures.caption ||
                       (parts.scale_bar && on_screens_of_desk() && !picture.audience.panel);
    if (!parts.marks) {
        kept.mark = {};
        kept.marks.clear();
        kept.told.reset();
        kept.tools = {};
    }
    if (parts.background != WrittenBackground::shown)
        kept.look.background = interaction::Background::white;
    kept.transparent = parts.background == WrittenBackground::transparent &&
                       !config_.pictures.only_kept && !outputs_.room() && !outputs_.headset();
    const index::ExtractionPtr& shown = sets_.shown();
    if (shown && (config_.pictures.caption || parts.caption))
        kept.caption = caption_text(shown->query, arrays_.file()->array(shown->query.array).info(),
                                    words_of(picture.further));
    return kept;
}

} // namespace isochron::app
