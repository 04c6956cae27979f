// What the control socket's thread and the loop of frames hand each other.
#include "app/control/control_desk.h"

#include "interaction/field.h"

#include <algorithm>
#include <utility>

namespace isochron::app {
namespace {

using interaction::Commands;

constexpr std::size_t kRemembered = 4 * ControlDesk::kMostBatches; ///< frames that obeyed something

/// Whether a frame may obey both as if the later ones had come a frame later.
bool go_together(const Commands& earlier, const Commands& later) {
    if (earlier.undo || earlier.redo || later.undo || later.redo)
        return false;
    // An isovalue is of the surface that was picked when it was asked for.
    if (earlier.isovalue && (later.picked || later.isosurfaces || later.array))
        return false;
    if (earlier.array && (later.isosurfaces || later.coloring || later.array))
        return false;
    return earlier.stamps.size() + later.stamps.size() <= interaction::kMostEvents &&
           earlier.haptics.size() + later.haptics.size() <= interaction::kMostEvents;
}

} // namespace

std::uint64_t ControlDesk::post(const Commands& commands) {
    std::uint64_t number = 0;
    bool first = false; // whoever takes a batch looks for the next one before it waits
    {
        const std::lock_guard lock(mutex_);
        first = batches_.empty();
        if (!batches_.empty() && go_together(batches_.back().commands, commands))
            interaction::merge(batches_.back().commands, commands);
        else if (batches_.size() < kMostBatches)
            batches_.push_back({.commands = commands});
        else
            return 0;
        number = batches_.back().last = ++posted_;
    }
    if (first)
        wake_loop();
    return number;
}

std::uint64_t ControlDesk::want_picture(bool now) {
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        number = ++(now ? wished_.now : wished_.final);
        (batches_.empty() ? wishes_ : batches_.back().wishes) = wished_;
    }
    wake_loop();
    return number;
}

std::shared_ptr<const ShownFrame> ControlDesk::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

std::uint64_t ControlDesk::frame_of(std::uint64_t request) const {
    const std::lock_guard lock(mutex_);
    const auto first = std::ranges::lower_bound(first_to_obey_, request, {}, &FirstToObey::request);
    return first != first_to_obey_.end() ? first->frame : shown_ ? shown_->number : 0;
}

std::shared_ptr<const ControlPicture> ControlDesk::picture() const {
    const std::lock_guard lock(mutex_);
    return picture_;
}

std::shared_ptr<const index::IndexFile> ControlDesk::file() const {
    const std::lock_guard lock(mutex_);
    return file_;
}

std::optional<ControlBatch> ControlDesk::take() {
    const std::lock_guard lock(mutex_);
    if (batches_.empty())
        return std::nullopt;
    ControlBatch batch = std::move(batches_.front());
    batches_.pop_front();
    wishes_ = {std::max(wishes_.now, batch.wishes.now),
               std::max(wishes_.final, batch.wishes.final)};
    return batch;
}

bool ControlDesk::has_commands() const {
    const std::lock_guard lock(mutex_);
    return !batches_.empty();
}

void ControlDesk::show(ShownFrame frame) {
    auto shown = std::make_shared<const ShownFrame>(std::move(frame));
    {
        const std::lock_guard lock(mutex_);
        if (shown->obeyed > (shown_ ? shown_->obeyed : 0))
            first_to_obey_.push_back({shown->obeyed, shown->number});
        if (first_to_obey_.size() > kRemembered)
            first_to_obey_.pop_front();
        std::swap(shown_, shown); // the frame before is freed behind the lock
    }
    if (interested_ && socket_wake_)
        socket_wake_();
}

PictureWishes ControlDesk::wishes() const {
    const std::lock_guard lock(mutex_);
    return wishes_;
}

void ControlDesk::give(ControlPicture picture) {
    {
        const std::lock_guard lock(mutex_);
        picture_ = std::make_shared<const ControlPicture>(std::move(picture));
    }
    if (socket_wake_)
        socket_wake_();
}

void ControlDesk::set_file(std::shared_ptr<const index::IndexFile> file) {
    const std::lock_guard lock(mutex_);
    file_ = std::move(file);
}

void ControlDesk::set_loop_wake(std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    loop_wake_ = std::move(wake);
}

void ControlDesk::wake_loop() {
    std::function<void()> wake;
    {
        const std::lock_guard lock(mutex_);
        wake = loop_wake_;
    }
    if (wake)
        wake();
}

} // namespace isochron::app
