// The search for active cells in an open index, by any tier that the file has.
#pragma once

#include "index/file/index_file.h"
#include "index/file/step_view.h"
#include "index/surface/cell_set.h"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

namespace isochron::index {

/// Computes one cell set. Call it on the worker only: it keeps the state of incremental search.
/// Returns null when stopped. @throws Error when it fails
using Search = std::function<CellSetPtr(const Query&, std::stop_token)>;

/// Fills an empty set of the caller, which may change it later. False when stopped.
using SearchInto =
    std::function<bool(const StepView& step, double isovalue, std::stop_token, CellSet&)>;
/// The step of a query. @throws Error if the series does not have it
StepView step_of_query(const IndexFile& file, Instant at, std::span<const double> isovalues = {});

/// The fastest method that the file's tiers allow: bricks, else the paper's tree, else the scan.
SearchMethod cheapest_method(const IndexFile& file);
/// Whether the file has the tier that a method needs.
bool can_search(const IndexFile& file, SearchMethod method);

/// `cells`: a set gets points and rows. `none`: it stays a list of ids.
enum class Shading : std::uint8_t { none, cells };

/// The search over an open index. Copies share their state.
/// @param method used instead of `cheapest_method`; the file must have that tier
/// @param shading `cells` completes the sets by `shade_cells`
Search search_in(std::shared_ptr<const IndexFile> file,
                 std::optional<SearchMethod> method = std::nullopt,
                 Shading shading = Shading::cells);
SearchInto search_into(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
                       Shading shading);

} // namespace isochron::index
