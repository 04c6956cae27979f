// The frames that the processes of a cluster show together, as one of them sees it.
#include "app/cluster/shared_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace isochron::app {

void SharedFrames::tell(const MessageBytes& bytes) {
    cluster_.tell(std::as_bytes(std::span(bytes)));
}

Latch SharedFrames::begin(const interaction::InputState& input,
                          const interaction::Commands& commands, Waiting waiting,
                          const Latch& latch, const stereo::Installation& installation) {
    if (!leads())
        return latch;
    auto newest = latch ? latch() : interaction::InputState{input.time, {}};
    std::vector<CellProgress> progress(cluster_.size());
    std::ranges::transform(answers_, progress.begin(), &FrameAnswer::cells);
    const FrameOrder order{input, commands, waiting, agreement_.decide(progress),
                           viewers_heads(newest, installation)};
    tell(encoded(order));
    cells_.obey(order.cells);
    return [newest = std::move(newest)] { return newest; };
}

std::optional<FrameOrder> SharedFrames::next() {
    auto order = decode_order(cluster_.hear());
    if (order)
        cells_.obey(order->cells);
    return order;
}

void SharedFrames::end() {
    if (leads())
        tell(encoded_end());
}

index::SurfacesQuery SharedFrames::ask(index::SurfacesQuery wanted, Waiting waiting) {
    return waiting == Waiting::never ? cells_.ask(wanted) : wanted;
}

CellsInFrame SharedFrames::cells(const index::Extractor& extractor,
                                 const index::ExtractionPtr& shown, Waiting waiting) {
    if (waiting == Waiting::for_cells)
        return {extractor.newest(), nullptr};
    cells_.look_at(extractor);
    CellsInFrame cells{std::nullopt, cells_.to_stage()};
    if (cells_.to_show() != shown)
        cells.show = cells_.to_show();
    return cells;
}

bool SharedFrames::parts_are_whole() const {
    return !answers_.empty() && std::ranges::all_of(answers_, &FrameAnswer::parts_whole);
}

Milliseconds SharedFrames::parts_took(Milliseconds) const {
    return std::ranges::max(answers_, {}, &FrameAnswer::parts_took).parts_took;
}

FramePlan SharedFrames::agree(const FramePlan& mine) {
    if (!leads())
        return decode_plan(cluster_.hear());
    tell(encoded(mine));
    return mine;
}

void SharedFrames::swap_barrier(const std::function<FrameAnswer()>& mine) {
    FrameAnswer told = mine();
    told.cells = cells_.progress();
    told.samples = std::exchange(samples_, {});
    const MessageBytes bytes = encoded(told);
    answers_.clear();
    for (const auto& answer : cluster_.gather(std::as_bytes(std::span(bytes))))
        answers_.push_back(decode_answer(answer));
}

bool SharedFrames::close_wanted() const {
    return std::ranges::any_of(answers_, &FrameAnswer::close);
}

std::string SharedFrames::failure(const index::Extractor&) const {
    for (unsigned each = 0; each < answers_.size(); ++each)
        if (!answers_[each].failure.empty())
            return each == 0
                       ? answers_[each].failure
                       : fmt::format("{}: {}", cluster_.name_of(each), answers_[each].failure);
    return {};
}

bool SharedFrames::has_no_answer(const index::Extractor& extractor) const {
    return !failure(extractor).empty();
}

DrawLoad SharedFrames::largest(const DrawLoad&) const {
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

void SharedFrames::take_note_of(const DrawSample& sample) {
    auto known =
        std::ranges::find(sampled_, sample.frame, [](const Sampled& s) { return s.slowest.frame; });
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

std::vector<DrawSample> SharedFrames::samples(std::vector<DrawSample> mine) {
    constexpr std::size_t kWaiting = 64; // frames; an older one was not drawn by all
    samples_ = std::move(mine);
    for (const FrameAnswer& answer : answers_)
        for (const DrawSample& sample : answer.samples)
            take_note_of(sample);
    std::vector<DrawSample> complete;
    std::erase_if(sampled_, [&](const Sampled& sampled) {
        if (sampled.told == cluster_.size())
            complete.push_back(sampled.slowest);
        return sampled.told == cluster_.size();
    });
    while (sampled_.size() > kWaiting)
        sampled_.pop_front();
    return complete;
}

} // namespace isochron::app
