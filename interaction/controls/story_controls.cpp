// The controls of a story.
#include "interaction/controls/story_controls.h"

#include "interaction/navigation/key_frames.h"
#include "interaction/navigation/story.h"

#include <algorithm>

namespace isochron::interaction {
namespace {

constexpr double kPushedAside = 0.5; ///< a stick that is pushed so far goes to another step

KeyTimes times_of_move() {
    return {{{0, 0}, {kStoryMove.count(), kStoryMove.count()}}};
}

} // namespace

/// The key that keys, buttons and sticks ask to be told.
std::uint32_t StoryControls::asked_for(const Reading& now, const Settings& settings,
                                       std::vector<std::string>& notes) {
    const bool told = told_key(settings) != nullptr;
    const double stick = now.wand_rate(WandValuator::step);
    const auto pushed = [&](double way) {
        return stick * way > kPushedAside && pushed_ * way <= kPushedAside;
    };
    const bool onwards = now.pressed(Action::next_told) ||
                         (told && (now.pressed(WandButton::next_time) ||
                                   now.pressed(GamepadButton::right) || pushed(1)));
    const bool back = now.pressed(Action::previous_told) ||
                      (told && (now.pressed(WandButton::previous_time) ||
                                now.pressed(GamepadButton::left) || pushed(-1)));
    pushed_ = stick;
    if (now.pressed(Action::leave_story) ||
        (told && now.pressed(Action::quit) && settings.tools == Tools{} && !settings.leaving))
        return 0;
    if (onwards == back)
        return settings.story;
    const StoryStep step = story_step(settings.keys, settings.story);
    if (step.of == 0)
        notes.emplace_back("there is no story: Ctrl + M makes what is seen a key, and the list of "
                           "keys below the picture gives it a text");
    const std::uint32_t to = onwards ? step.next : step.previous;
    if (step.of > 0 && to == 0)
        notes.emplace_back(onwards ? "this is the last step of the story"
                                   : "this is the first step of the story");
    return to == 0 ? settings.story : to;
}

/// What a key shows is set at once; the data move to where they lie there.
void StoryControls::begin(const KeyFrame& key, const Reading& now, const ControlContext& context,
                          Seconds time, Commands& commands) {
    const Similarity& from = context.settings.room_from_physical;
    Commands shown = way_to_key(key, context.settings, now.viewer());
    const std::optional<Similarity> to = shown.room_from_physical;
    Way way{.began = time, .leap = {}, .motion = {}, .last = from};
    if (context.fades) {
        way.leap = std::move(shown);
    } else {
        shown.room_from_physical.reset();
        merge(commands, shown);
        if (!to)
            return way_.reset();
        way.motion.emplace(times_of_move(), std::vector{from, *to}, context.series.pivot);
    }
    way_ = std::move(way);
}

void StoryControls::go_on(const Settings& settings, Seconds time, Commands& commands) {
    commands.story = commands.story.value_or(settings.story);
    const Seconds passed = time - way_->began;
    if (!way_->motion) {
        if (passed < kStoryLeap)
            return;
        merge(commands, way_->leap);
        return way_.reset();
    }
    const bool arrives = passed >= kStoryMove;
    way_->last = way_->motion->at(arrives ? KeyPlace{1, 0}
                                          : times_of_move().place(std::max(0.0, passed.count())));
    commands.room_from_physical = way_->last;
    if (arrives)
        way_.reset();
}

void StoryControls::update(const Reading& now, const ControlContext& context, Seconds time,
                           Commands& commands, std::vector<std::string>& notes) {
    const Settings& settings = context.settings;
    const std::uint32_t told = asked_for(now, settings, notes);
    if (told != settings.story)
        commands.story = told;
    // Who grabs the data, or sets the view by other means, has it; the rest of the step comes.
    const bool taken =
        commands.room_from_physical || (way_ && !(way_->last == settings.room_from_physical));
    if (way_ && told > 0 && taken && !way_->motion) {
        way_->leap.room_from_physical.reset();
        merge(commands, way_->leap);
        commands.story = told;
    }
    if (way_ && (taken || told == 0))
        way_.reset();
    if (told_ && *told_ != told && told > 0 && told <= settings.keys.size()) {
        commands.story = told;
        begin(settings.keys[told - 1], now, context, time, commands);
    }
    told_ = told;
    if (way_)
        go_on(settings, time, commands);
}

} // namespace isochron::interaction
