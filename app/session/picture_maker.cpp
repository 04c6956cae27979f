// The contents of a session's pictures, and their notes.
#include "app/session/session.h"

#include "app/scene/caption.h"

#include <fmt/format.h>

namespace isochron::app {

/// Whether the windows show the scene themselves: always without a headset; beside a headset only
/// after it has wanted no picture for a moment.
bool Session::in_windows(const FrameReport& report) {
    constexpr interaction::Seconds kMoment{0.5};
    if (!outputs_.headset_eyes().empty())
        in_headset_ = report.time;
    return !in_headset_ || report.time - *in_headset_ > kMoment;
}

/// The same picture as it is kept.
Picture Session::kept(const Picture& picture) const {
    Picture kept = picture;
    if (!config_.picture_ray) {
        kept.pointed.reset();
        kept.audience.wand.reset();
    }
    kept.orientation = config_.picture_caption;
    if (const index::ExtractionPtr& shown = scene_.cells().shown();
        shown && config_.picture_caption)
        kept.caption = caption_text(shown->query, file_->array(shown->query.array).info());
    return kept;
}

std::size_t Session::draw_views(const ScenePlace& place, std::span<const render::View> views,
                                const Picture& picture, const ScenePart& part) {
    return scene_.draw(place.kept ? kept(picture) : picture, views, part);
}

void Session::warm_up() {
    if (outputs_.headset())
        return;
    Picture picture;
    picture.audience.viewers =
        viewer_poses(config_.installation, {}, state_.eye_separation, parallel_center());
    picture.audience.stereo = state_.stereo;
    picture.room_from_physical = state_.room_from_physical;
    picture.isosurfaces = state_.isosurfaces;
    picture.look = state_.look;
    picture.mark = state_.mark;
    picture.bounding_box = state_.bounding_box;
    outputs_.draw(picture.audience,
                  [this, picture](const ScenePlace&, std::span<const render::View> views) {
                      scene_.warm_up(picture, views);
                  },
                  {});
    Outputs::SlicePlace place; // what is drawn over several frames has a place of its own
    const auto nothing = [](const ScenePlace&, std::span<const render::View>) { return true; };
    for (bool whole = false; !whole;)
        whole = outputs_.draw_slice(place, nothing);
}

/// Where mouse and keyboard play the wand, it points while the cursor does.
Aids Session::aids(const interaction::InputState& input) const {
    const bool points =
        !head_is_emulated() || room_panel_.touched() || input.find("pointer") != nullptr;
    const interaction::DeviceState* wand =
        config_.wand_ray && points ? input.find("wand") : nullptr;
    return {wand ? wand->pose : std::nullopt,
            picker_.pointed(input, !room_panel_.touched(), state_, scene_.cells().shown())};
}

/// At a desktop only the cursor moves for long: the picture below it stays as it is.
bool Session::aids_lie_over() const {
    const bool one_picture_each = !stereo::Multiplex::shows(state_.stereo) &&
                                  stereo::upright(state_.stereo) != stereo::StereoMode::quadbuffer;
    return head_is_emulated() && !outputs_.room() && !config_.picture_ray &&
           outputs_.displays() == 1 && one_picture_each;
}

void Session::draw_aids() {
    if (!over_.wand && !over_.pointed)
        return;
    for (const render::View& view : outputs_.display().views_in_window(outputs_.audience().viewers))
        scene_.draw_aids(*drawn_, over_, view);
}

/// Whether the windows are on a desktop rather than walls: there users need help with orientation.
bool Session::on_desktop(const Audience& audience) const {
    const auto& screens = config_.installation.windows.front().viewports;
    return outputs_.windows().first().has_window() && outputs_.shows_windows(audience) &&
           !outputs_.room() && screens.front().screen.fit_aspect;
}

PictureNote Session::note() const {
    PictureNote note;
    note.data = data_name_;
    note.recorded_on = recorded_on_;
    note.data_hash = fmt::format("{:016x}", file_->content_hash());
    note.footprint = name_of(drawn_ ? drawn_->footprint : render::Footprint{});
    ExplorerState state = state_;
    if (const index::ExtractionPtr& shown =
            scene_.cells().shown()) { // may lag behind while time plays
        state.step = shown->query.step;
        for (std::size_t i = 0; i < shown->query.isovalues.size() && i < state.isosurfaces.size();
             ++i)
            state.isosurfaces[i].isovalue = shown->query.isovalues[i];
    }
    note.state = state.as_commands();
    note.input = input_;
    note.latched = latched_;
    return note;
}

} // namespace isochron::app
