// The one background worker: newest request in, newest finished cell set out, never a wait.
//
//     index::Extractor extractor(index::search_in(file));
//     extractor.request({.query = {step, isovalue}, .next_step = step + 1});
//     if (auto set = extractor.newest()) draw(*set);      // every frame, never blocks
#pragma once

#include "index/cell_set.h"
#include "index/index_file.h"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace isochron::index {

/// Computes one cell set; runs on the worker only, keeps the state of incremental search.
/// Returns null when stopped. Throws to report a failure.
using Search = std::function<CellSetPtr(const Query&, std::stop_token)>;

/// What the file's tiers answer fastest: cells, else bricks, else the paper's tree, else the scan.
SearchMethod cheapest_method(const IndexFile& file);
/// Whether the file has what a method works on.
bool can_search(const IndexFile& file, SearchMethod method);

/// The search over an open index. Copies share their state.
/// @param method instead of the cheapest; the file must have that tier
Search search_in(std::shared_ptr<const IndexFile> file,
                 std::optional<SearchMethod> method = std::nullopt);

struct Request {
    Query query;
    std::optional<std::uint32_t> next_step; ///< prefetched once the query is answered (playback)
};

/// Requests may come faster than a search takes. After one abandoned search the next is therefore
/// finished and shown although something newer has been asked for; so the picture follows a slider
/// or a fast playback instead of standing still until they stop.
class Extractor {
  public:
    explicit Extractor(Search search);
    ~Extractor(); ///< stops and joins the worker
    Extractor(const Extractor&) = delete;
    Extractor& operator=(const Extractor&) = delete;

    /// Replaces whatever was asked before; work for an older query is abandoned at its next check.
    /// Asking again for what is already asked does nothing. Never waits for the worker.
    void request(const Request& request);

    /// The newest finished set, null before the first; stays the same until a newer one is
    /// finished.
    CellSetPtr newest() const;

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
