// The one background worker: newest request in, newest finished extraction out, never a wait.
//
//     index::Extractor extractor(index::extract_from(file));
//     extractor.request({.query = {step, {isovalue}}, .ahead = index::StepsAhead{step + 1}});
//     if (const auto newest = extractor.newest())              // every frame, never blocks
//         show(newest);
#pragma once

#include "index/extraction/extraction.h"
#include "index/extraction/recent_extractions.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

struct Request {
    SurfacesQuery query;
    /// Prefetched once the query is answered (playback), as many as there is room for. Not while
    /// the isovalues are dragged: the next query will be for others.
    std::optional<StepsAhead> ahead;
};

/// Requests may come faster than a search takes. After one abandoned search the next is therefore
/// finished and shown although something newer has been asked for; so the picture follows a slider
/// or a fast playback instead of standing still until they stop.
class Extractor {
  public:
    /// @param room bytes of extractions that are kept, the newest three in any case
    explicit Extractor(Extract extract, std::uint64_t room = 0);
    ~Extractor(); ///< stops and joins the worker
    Extractor(const Extractor&) = delete;
    Extractor& operator=(const Extractor&) = delete;

    /// Replaces whatever was asked before; work for an older query is abandoned at its next check.
    /// Asking again for what is already asked does nothing. What is at hand is shown at once. Never
    /// waits for the worker.
    void request(const Request& request);

    /// Answers what is asked for anew, as if nothing had been answered yet; what is shown stays
    /// until then.
    void forget();

    /// The newest finished extraction, null before the first; stays the same until a newer one is
    /// finished.
    ExtractionPtr newest() const;

    /// Steps whose extractions for the newest request's surfaces are at hand, ascending.
    std::vector<std::uint32_t> at_hand() const;

    /// Message of the last failure, until a later query succeeds.
    std::optional<std::string> failure() const;

    /// True while the newest request has neither been answered nor failed.
    bool busy() const;

    /// Blocks until not busy: for fixed-step replay, captures and tests only, never in the live
    /// loop.
    void wait() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::index
