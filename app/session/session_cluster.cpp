// A session's part in the frames that several processes show together.
#include "app/session/session.h"

#include <utility>

namespace isochron::app {

/// What all show; and on its way to the GPU, what all will show next.
void Session::show_shared_cells() {
    SharedCells& cells = shared_->cells();
    cells.look_at(extractor_);
    if (cells.to_show() != scene_.shown())
        scene_.upload(cells.to_show());
    if (const index::ExtractionPtr next = cells.to_stage(); next && scene_.stage(next))
        cells.staged();
}

bool Session::should_close() const {
    return outputs_.windows().should_close() || (shared_ && shared_->close_wanted());
}

std::string Session::failure() const {
    return shared_ ? shared_->failure() : extractor_.failure().value_or("");
}

/// The newest query will not be answered: alike in all processes.
bool Session::has_no_answer() const {
    return shared_ ? !shared_->failure().empty() : extractor_.failure() && !extractor_.busy();
}

/// The slowest process counts: all draw with one footprint.
void Session::learn_costs() {
    samples_ = quality_.collect(log_);
    if (!shared_)
        return quality_.learn(samples_);
    quality_.learn(shared_->samples());
    quality_.charge(shared_->view());
}

/// So that every wall shows the same frame at the same time.
void Session::wait_for_others() {
    outputs_.gl().Finish(); // what is drawn yet would be shown later
    FrameAnswer answer;
    answer.close = outputs_.windows().should_close();
    answer.failure = extractor_.failure().value_or("");
    answer.view = quality_.view();
    answer.surface_limit = scene_.surface_limit();
    answer.samples = std::move(samples_);
    shared_->swap_barrier(std::move(answer));
}

/// Rank 0's. @return whether it wants this frame measured
bool Session::take_shared_choice(bool measure, FrameReport& report) {
    const FrameChoice choice =
        shared_->agree({report.footprint, report.reason, report.final, measure});
    report.footprint = choice.footprint;
    report.reason = choice.reason;
    report.final = choice.final;
    return choice.measure;
}

} // namespace isochron::app
