// GPU and processor time of drawing each frame.
#include "app/quality/draw_meter.h"

#include <cassert>

namespace isochron::app {

void DrawMeter::begin(std::uint64_t frame) {
    frame_ = frame;
    timed_ = timer_.begin(frame, Clock::now());
}

void DrawMeter::end(render::Footprint footprint, const DrawLoad& load, Milliseconds processor,
                    std::size_t resolution) {
    timer_.end();
    const DrawSample sample{frame_, footprint, load, processor, std::nullopt, resolution};
    if (timed_)
        under_way_.push_back(sample);
    else if (!timer_.works())
        finished_.push_back(sample);
}

std::vector<DrawSample> DrawMeter::finished() {
    std::vector<DrawSample> done;
    while (const auto span = timer_.take(Clock::now())) {
        assert(!under_way_.empty() && under_way_.front().frame == span->tag);
        under_way_.front().gpu = span->time;
        done.push_back(under_way_.front());
        under_way_.pop_front();
    }
    done.insert(done.end(), finished_.begin(), finished_.end());
    finished_.clear();
    return done;
}

} // namespace isochron::app
