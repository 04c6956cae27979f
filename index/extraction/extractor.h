// The background worker: takes the newest request, gives the newest finished extraction, without
// making the caller wait.
//
//     index::Extractor extractor(index::extract_from(file));
//     extractor.request({.query = {index::Instant(step), {isovalue}},
//                        .ahead = index::StepsAhead{step + 1}});
//     if (const auto newest = extractor.newest())              // every frame, never blocks
//         show(newest);
#pragma once

#include "index/extraction/extraction.h"
#include "index/extraction/recent_extractions.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochron::index {

struct Request {
    SurfacesQuery query;
    /// Steps to prefetch once the query is answered (during playback), as many as there is room
    /// for. Leave it empty while isovalues are dragged: the next query will have others.
    std::optional<StepsAhead> ahead;
    /// Once the query is answered, meshes of all levels that fit into this room [bytes] are made of
    /// this extraction (Extraction::later), unless it has them; null: none are.
    ExtractionPtr meshes_of = nullptr;
    std::uint64_t later_room = 0;
    /// Meshes that are being made of these cells give way to the query. Otherwise they come first for
    /// a moment.
    bool before_meshes = false;
};

/// Whether a search is finished although a newer request waits: it has come so far that this delays
/// the newer one little. False where the last search was too short to be a measure, or where this
/// one takes far longer.
/// @param since_start of the search @param last_took time of the last search that found something
bool is_worth_finishing(std::chrono::nanoseconds since_start, std::chrono::nanoseconds last_took);

/// Requests may come faster than searches finish. So after one abandoned search the next one is
/// finished and shown even if there is a newer request, and so is one that `is_worth_finishing`.
/// The picture then follows a slider or a fast playback instead of standing still until they stop.
class Extractor {
  public:
    /// @param room [bytes] for extractions that are kept; the newest three are always kept
    explicit Extractor(Extract extract, std::uint64_t room = 0);
    ~Extractor(); ///< stops and joins the worker
    Extractor(const Extractor&) = delete;
    Extractor& operator=(const Extractor&) = delete;

    /// Sets the function that the worker calls, on its thread, whenever a search has ended.
    void set_wake(std::function<void()> wake);

    /// Replaces the request before; work on an older query is abandoned at its next check. Does
    /// nothing if the request is the same. A kept extraction is the newest at once. Never waits for
    /// the worker.
    void request(const Request& request);
    /// Drops all kept extractions and answers the request again; `newest` stays until then.
    void forget();

    /// The newest finished extraction; null before the first.
    ExtractionPtr newest() const;

    /// Steps whose extractions for the newest request's surfaces are kept, ascending.
    std::vector<std::uint32_t> at_hand() const;

    /// The message of the last failure; none once a later query has succeeded.
    std::optional<std::string> failure() const;
    /// True until the newest request has been answered or has failed.
    bool busy() const;

    /// Blocks until not busy, and until the meshes are made that come later: for fixed-step replay, captures and tests only, never in the live loop.
    void wait() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace isochron::index
