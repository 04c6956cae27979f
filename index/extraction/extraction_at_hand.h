// The last extraction of an index, and what of it the next one can take over.
#pragma once

#include "index/extraction/extraction.h"
#include "index/extraction/joined_cells.h"
#include "index/extraction/surface_colors.h"
#include "index/search/layer_search.h"
#include "index/search/staying_cells.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>

namespace isochron::index {

/// A set that is at hand has the cells of chunks that stay, at isovalues that stay. Functions throw
/// as ChunkStore does. Not thread-safe.
class ExtractionAtHand {
  public:
    /// @param layers outlives this @param shading of the sets
    /// @param free to choose how cells are found; else nothing is taken over
    ExtractionAtHand(std::shared_ptr<const IndexFile> file, LayerSearch& layers, Shading shading,
                     bool free)
        : file_(std::move(file)), layers_(layers), shading_(shading), free_(free) {}

    /// Remembers an extraction, unless it is of coarser levels.
    /// @param same_colors its colors are of the same ranges as those to come
    void set(const ExtractionPtr& made, bool same_colors = true);
    const ExtractionPtr& get() const { return from_; }
    /// The number of the extraction at hand if it has as many surfaces; else 0.
    std::uint64_t number_for(const SurfacesQuery& query) const {
        return from_ && from_->surfaces.size() == query.isovalues.size() ? from_->number : 0;
    }

    /// Decides what of the extraction at hand is taken over for a query.
    void begin(const SurfacesQuery& query);

    /// Whether the cells of a surface are taken over where they stay.
    bool keeps_cells(std::size_t surface) const;
    /// Finds the cells of a surface that keeps cells. @param meshed a mesh may follow
    /// @return false when stopped
    bool find(std::size_t surface, bool meshed, const std::stop_token& stop, CellSet& set,
              SurfaceChange& change);
    /// The mesh of the cells that the last `find` kept, with its colors if these can be kept; none if
    /// it was not meshed.
    EarlierMesh mesh() const;

    /// Whether the extraction at hand is of the same step, some of whose chunks are in memory then.
    bool of_same_step() const {
        return staying_ && from_->query.instant == query_.instant &&
               file_->plan().tiers.has(Tier::bricks);
    }
    /// Where work on a part of the step's cells finds its values.
    const StepView& step() const { return *step_; }
    /// The colors that cells may take over, once all surfaces have been found.
    KnownColors colors() const;
    /// The surroundings that are taken over where the volume stays; null: none.
    const SurroundingField* surroundings() const;
    /// What is known of the extraction at hand, which must be there.
    std::uint32_t earlier_step() const { return from_->query.instant.step; }
    /// The blocks that are taken over. @param only_if_same_levels for other isovalues they differ
    KnownBlocks blocks(bool only_if_same_levels) const;

  private:
    bool may_keep(const SurfacesQuery& query) const;
    bool enough_stays(double chunks) const;
    bool pays(std::size_t cells) const;
    void look_at_colors();
    void keep_colors(std::size_t surface, const CellSet& set);

    std::shared_ptr<const IndexFile> file_;
    LayerSearch& layers_;
    Shading shading_;
    bool free_;
    ExtractionPtr from_;
    bool same_colors_ = true;
    // For the query that is being answered:
    SurfacesQuery query_;
    bool finds_anew_ = false; ///< all cells, as that takes less time
    unsigned looks_ = 0;      ///< at the same step, one after the other
    std::optional<StepView> step_;
    std::optional<StayingCells> staying_; ///< none if nothing is taken over
    /// What stays of the array to color by; none if no colors are taken over.
    std::optional<StayingCells> staying_colors_;
    CellMeshPtr mesh_;                ///< mesh of the last surface that was found
    CellsOfMesh cells_;               ///< cells of that mesh
    std::vector<std::uint8_t> inner_; ///< EarlierMesh, of the surface that was found
    /// EarlierMesh::places of each surface; empty where nothing is kept, or nobody asks.
    std::vector<std::vector<std::uint32_t>> places_;
    /// EarlierMesh::colored of each surface, also without a mesh.
    std::vector<std::vector<std::uint32_t>> colored_;
    std::size_t found_ = 0; ///< the last surface that was found
};

} // namespace isochron::index
