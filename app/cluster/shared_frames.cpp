// The frames that the processes of a cluster show together, seen from one of them.
#include "app/cluster/shared_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace isochron::app {

void SharedFrames::tell(const MessageBytes& bytes) {
    cluster_.tell(std::as_bytes(std::span(bytes)));
}

void SharedFrames::begin(const interaction::InputState& input,
                         const interaction::Commands& commands, Waiting waiting,
                         const interaction::InputState& latched) {
    std::vector<CellProgress> progress(size());
    std::ranges::transform(answers_, progress.begin(), &FrameAnswer::cells);
    const FrameOrder order{input, commands, waiting, agreement_.decide(progress), latched};
    tell(encoded(order));
    cells_.obey(order.cells);
}

std::optional<FrameOrder> SharedFrames::next() {
    auto order = decode_order(cluster_.hear());
    if (order)
        cells_.obey(order->cells);
    return order;
}

FrameChoice SharedFrames::agree(const FrameChoice& mine) {
    if (!leads())
        return decode_choice(cluster_.hear());
    tell(encoded(mine));
    return mine;
}

void SharedFrames::swap_barrier(FrameAnswer mine) {
    mine.cells = cells_.progress();
    const MessageBytes bytes = encoded(mine);
    answers_.clear();
    for (const auto& answer : cluster_.gather(std::as_bytes(std::span(bytes))))
        answers_.push_back(decode_answer(answer));
}

bool SharedFrames::close_wanted() const {
    return std::ranges::any_of(answers_, &FrameAnswer::close);
}

std::string SharedFrames::failure() const {
    for (unsigned each = 0; each < answers_.size(); ++each)
        if (!answers_[each].failure.empty())
            return each == 0
                       ? answers_[each].failure
                       : fmt::format("{}: {}", cluster_.name_of(each), answers_[each].failure);
    return {};
}

DrawLoad SharedFrames::view() const {
    DrawLoad most;
    for (const FrameAnswer& answer : answers_) {
        most.cells = std::max(most.cells, answer.view.cells);
        most.pixels = std::max(most.pixels, answer.view.pixels);
    }
    return most;
}

std::uint64_t SharedFrames::surface_limit() const {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (const FrameAnswer& answer : answers_)
        least = std::min(least, answer.surface_limit);
    return least;
}

std::vector<DrawSample> SharedFrames::samples() {
    constexpr std::size_t kWaiting = 64; // frames; later a frame was not drawn by all
    for (const FrameAnswer& answer : answers_)
        for (const DrawSample& sample : answer.samples) {
            auto known = std::ranges::find(sampled_, sample.frame,
                                           [](const Sampled& s) { return s.slowest.frame; });
            if (known == sampled_.end())
                known = sampled_.insert(known, {sample, 0});
            ++known->told;
            DrawSample& slowest = known->slowest;
            const DrawLoad load{std::max(slowest.load.cells, sample.load.cells),
                                std::max(slowest.load.pixels, sample.load.pixels)};
            if (sample.cost() > slowest.cost())
                slowest = sample;
            slowest.load = load;
        }
    std::vector<DrawSample> complete;
    std::erase_if(sampled_, [&](const Sampled& sampled) {
        if (sampled.told == size())
            complete.push_back(sampled.slowest);
        return sampled.told == size();
    });
    while (sampled_.size() > kWaiting)
        sampled_.pop_front();
    return complete;
}

} // namespace isochron::app
