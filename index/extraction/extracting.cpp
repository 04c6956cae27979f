// Searches for every surface, copies the blocks that the cells need, and colors the cells.
#include "index/extraction/extraction.h"

#include "index/detail/detail_search.h"
#include "index/error.h"
#include "index/extraction/extraction_at_hand.h"
#include "index/extraction/kept_cells.h"
#include "index/extraction/surface_colors.h"
#include "index/measure/mesh_pieces.h"
#include "index/surface/mesh_colors.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace isochron::index {
namespace {

std::atomic<std::uint64_t> last_number = 0; ///< number of the newest extraction

class Extracting {
  public:
    Extracting(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
               Shading shading)
        : file_(std::move(file)), method_(method),
          // By wide ids a renderer cannot tell where cells are.
          shading_(has_wide_ids(file_->info().grid) ? Shading::cells : shading),
          values_(file_->info().type, file_->info().scaling, file_->stats().low,
                  file_->stats().high),
          gatherer_(file_->info().grid, values_), blended_values_(blended_values(*file_)),
          blended_gatherer_(file_->info().grid, blended_values_), layers_(file_),
          colors_(file_, method), details_(file_), complete_(is_complete(*file_)),
          at_hand_(file_, layers_, shading_, !method) {}

    ExtractionPtr operator()(const SurfacesQuery& query, const std::stop_token& stop) {
        const std::size_t count = query.isovalues.size();
        if (count < 1 || count > kMostSurfaces)
            throw Error("{} isovalues: expected 1 to {}", count, kMostSurfaces);
        auto result = std::make_shared<Extraction>();
        result->query = query;
        result->number = ++last_number;
        try {
            const StepView step = step_of_query(*file_, query.instant, query.isovalues);
            if (!query.pieces.keeps_all())
                return make_of_pieces(result, step, stop);
            ExtractionPtr made = make(result, step, stop);
            if (made)
                at_hand_.set(made);
            return made;
        } catch (const Stopped&) {
            return nullptr;
        }
    }

    /// Begins with what has been extracted from an earlier state of the index.
    void continue_from(const Extracting& earlier) {
        const std::vector<std::uint64_t>& states = file_->metadata().earlier;
        const IndexStats &now = file_->stats(), &before = earlier.file_->stats();
        // Values that are converted for blocks depend on the range.
        const bool same_blocks =
            gatherer_.without_levels() || (now.low == before.low && now.high == before.high);
        if (same_blocks && earlier.at_hand_.get() &&
            std::ranges::find(states, earlier.file_->content_hash()) != states.end())
            at_hand_.set(earlier.at_hand_.get(), false);
    }

  private:
    /// The values of blocks between two steps, where these are stored in another way than at steps.
    static BlockValues blended_values(const IndexFile& file) {
        const Blend blend(file.info().type, file.info().scaling, 1);
        return {blend.type(), blend.scaling(), file.stats().low, file.stats().high};
    }
    bool as_at_steps(const StepView& step) const {
        return step.type() == file_->info().type && step.scaling() == file_->info().scaling;
    }
    const BlockValues& values_of(const StepView& step) const {
        return as_at_steps(step) ? values_ : blended_values_;
    }
    BlockGatherer& gatherer_of(const StepView& step) {
        return as_at_steps(step) ? gatherer_ : blended_gatherer_;
    }

    /// @return null when stopped
    ExtractionPtr make(const std::shared_ptr<Extraction>& result, const StepView& step,
                       const std::stop_token& stop) {
        const SurfacesQuery& query = result->query;
        at_hand_.begin(query);
        const bool keeps = keeps_any(query);
        const bool may_have_too_many = this->may_have_too_many(query);
        // A large step is not searched as a whole before it is known that its cells fit.
        // What is at hand does not decide it: processes of a job may have different sets at hand.
        if (step.by_chunks() && may_have_too_many)
            if (const auto made = make_of_levels(step, result, stop))
                return *made;
        // What is in memory is enough: reading the step as a whole takes longer.
        const StepView& near = at_hand_.of_same_step() ? at_hand_.step() : step;
        // Cells are counted in a fraction of the time that their planes and triangles take.
        const bool counts_first = may_have_too_many && !step.by_chunks() && !keeps;
        if (counts_first) {
            result->volume_cells = count(near, query, stop);
            if (!result->volume_cells)
                return nullptr;
            if (*result->volume_cells > query.detail.most_cells)
                if (const auto made = make_of_levels(step, result, stop))
                    return *made;
        }
        if (!search(near, *result, mesh_room(query), stop))
            return nullptr;
        result->volume_cells = result->cells();
        if (may_have_too_many && !counts_first && result->cells() > query.detail.most_cells)
            if (const auto made = make_of_levels(step, result, stop))
                return *made;
        return fill(keeps ? at_hand_.step() : near, *result, at_hand_.colors(), stop) ? result
                                                                                      : nullptr;
    }

    /// Pieces are told apart on the whole surfaces of the volume itself, which are at hand for the
    /// next extraction. What is kept is the answer; of coarser levels, where it has too many cells, what
    /// stands for it. @return null when stopped
    ExtractionPtr make_of_pieces(const std::shared_ptr<Extraction>& result, const StepView& step,
                                 const std::stop_token& stop) {
        constexpr std::uint64_t kMostCells = std::uint64_t{1} << 23; // some 100 bytes each
        constexpr std::uint64_t kAnyRoom = std::numeric_limits<std::uint64_t>::max();
        const SurfacesQuery& query = result->query;
        auto whole = std::make_shared<Extraction>();
        whole->query = query;
        whole->query.pieces = {};
        whole->query.detail = {};
        whole->number = ++last_number;
        at_hand_.begin(whole->query);
        const bool keeps = keeps_any(query);
        if (file_->info().grid.cell_count() * query.isovalues.size() > kMostCells) {
            auto cells = step.by_chunks() ? details_.count(query, stop) : std::nullopt;
            if (!cells && !stop.stop_requested())
                cells = count(step, query, stop);
            if (!cells)
                return nullptr;
            if (*cells > kMostCells) {
                result->pieces.too_many_cells = true;
                return make(result, step, stop);
            }
        }
        const StepView& near = at_hand_.of_same_step() ? at_hand_.step() : step;
        if (!search(near, *whole, kAnyRoom, stop))
            return nullptr;
        const std::vector<KeptPieces> kept = keep_pieces(*whole, *result);
        if (stop.stop_requested())
            return nullptr;
        const std::uint64_t most = query.detail.most_cells;
        const std::uint64_t cells = result->cells();
        if (most > 0 && cells > most) {
            result->volume_cells = whole->cells();
            const auto made = make_of_levels(step, result, stop);
            if (made && !*made)
                return nullptr;
            result->volume_cells = cells;
            if (made) {
                keep_levels(file_->info().grid, whole->surfaces, kept, *result);
                at_hand_.set(whole);
                return result;
            }
        }
        result->volume_cells = cells;
        if (!fill(keeps ? at_hand_.step() : near, *result, {}, stop))
            return nullptr;
        whole->blocks = result->blocks;
        whole->levels = result->levels;
        whole->surroundings = result->surroundings;
        at_hand_.set(whole);
        return result;
    }

    /// Fills in the cells of kept pieces. @param whole with meshes of all surfaces
    std::vector<KeptPieces> keep_pieces(const Extraction& whole, Extraction& result) const {
        std::vector<KeptPieces> all;
        std::uint64_t room = mesh_room(result.query);
        for (std::size_t i = 0; i < whole.surfaces.size(); ++i) {
            const CellSet& from = whole.surfaces[i];
            KeptPieces& kept = all.emplace_back();
            if (from.mesh)
                kept =
                    kept_pieces(*from.mesh, file_->info().grid, complete_, result.query.pieces, i);
            result.pieces.all += kept.all;
            result.pieces.kept += kept.kept;
            CellSet& to = result.surfaces.emplace_back(cells_of_kept(from, kept));
            if (to.ids.empty() || least_mesh_bytes(to.ids.size()) > room)
                continue;
            CellMeshPtr mesh = from.mesh;
            if (!kept.cells.empty()) {
                auto part = std::make_shared<CellMesh>(*mesh);
                keep(*part, kept);
                mesh = std::move(part);
            }
            if (const std::uint64_t bytes = bytes_of(*mesh); bytes <= room) {
                room -= bytes;
                to.mesh = std::move(mesh);
            }
        }
        drop_unless_meshed(result);
        return all;
    }

    /// Without planes of cells, nothing draws meshes.
    std::uint64_t mesh_room(const SurfacesQuery& query) const {
        return shading_ == Shading::none ? 0 : query.mesh_room;
    }

    bool keeps_any(const SurfacesQuery& query) const {
        for (std::size_t i = 0; i < query.isovalues.size(); ++i)
            if (at_hand_.keeps_cells(i))
                return true;
        return false;
    }

    bool may_have_too_many(const SurfacesQuery& query) const {
        const std::uint64_t cells = file_->info().grid.cell_count() * query.isovalues.size();
        return query.detail.most_cells > 0 && cells > query.detail.most_cells;
    }

    /// @return null when stopped; empty if all cells should be the volume's own
    std::optional<ExtractionPtr> make_of_levels(const StepView& step,
                                                const std::shared_ptr<Extraction>& result,
                                                const std::stop_token& stop) {
        DetailCells found;
        switch (details_.find(result->query, result->volume_cells, found, stop)) {
        case DetailSearch::Outcome::stopped: return nullptr;
        case DetailSearch::Outcome::whole: return std::nullopt;
        case DetailSearch::Outcome::made: break;
        }
        result->surfaces = std::move(found.surfaces);
        result->change = {};
        result->colors = std::move(found.colors);
        result->detail = std::move(found.levels);
        result->coarsest = found.coarsest;
        if (!result->volume_cells && result->query.detail.at_rest) { // there is time for it
            result->volume_cells = details_.count(result->query, stop);
            if (stop.stop_requested())
                return nullptr;
        }
        const auto started = std::chrono::steady_clock::now();
        result->levels = values_of(step).levels(result->query.isovalues).units;
        result->blocks = gatherer_of(step).none();
        if (result->cells() > 0)
            find_surroundings(step_in_chunks(*file_, result->query.instant), *result, stop);
        result->gather_time = std::chrono::steady_clock::now() - started;
        return result;
    }

    /// The number of cells of the volume itself. @return empty when stopped
    std::optional<std::uint64_t> count(const StepView& step, const SurfacesQuery& query,
                                       const std::stop_token& stop) {
        std::uint64_t cells = 0;
        for (std::size_t i = 0; i < query.isovalues.size(); ++i) {
            if (counts_.size() == i)
                counts_.push_back(search_into(file_, method_, Shading::none));
            CellSet ids;
            if (!counts_[i](step, query.isovalues[i], stop, ids))
                return std::nullopt;
            cells += ids.ids.size();
        }
        return cells;
    }

    /// Finds the cells of the volume itself. @param room for their meshes @return false when stopped
    bool search(const StepView& step, Extraction& found, std::uint64_t room,
                const std::stop_token& stop) {
        const SurfacesQuery& query = found.query;
        found.surfaces.clear();
        found.change = {at_hand_.number_for(query),
                        std::vector<SurfaceChange>(query.isovalues.size())};
        std::optional<ColorSource> colors;
        if (query.coloring == CellColoring::value && query.colors < ColorSource::count(*file_))
            colors.emplace(*file_, query.colors);
        for (std::size_t i = 0; i < query.isovalues.size(); ++i) {
            if (searches_.size() == i)
                searches_.push_back(search_into(file_, method_, shading_));
            CellSet& set = found.surfaces.emplace_back();
            if (!search_surface(step, i, found, room > 0, stop))
                return false;
            const bool keeps = at_hand_.keeps_cells(i);
            if (!add_mesh(keeps ? at_hand_.step() : step, set, room, colors,
                          keeps ? at_hand_.mesh() : EarlierMesh{}, stop))
                return false;
            room = set.mesh ? room - bytes_of(*set.mesh) : set.ids.empty() ? room : 0;
        }
        drop_unless_meshed(found);
        return true;
    }

    /// Meshes of some surfaces without the others are never drawn.
    static void drop_unless_meshed(Extraction& found) {
        if (!found.meshed())
            for (CellSet& surface : found.surfaces)
                surface.mesh.reset();
    }

    /// @return false when stopped
    bool search_surface(const StepView& step, std::size_t i, Extraction& found, bool meshed,
                        const std::stop_token& stop) {
        CellSet& set = found.surfaces[i];
        if (at_hand_.keeps_cells(i))
            return at_hand_.find(i, meshed, stop, set, found.change.surfaces[i]);
        found.change.from = 0;
        return searches_[i](step, found.query.isovalues[i], stop, set);
    }

    /// Adds a mesh if it does not take more room. @return false when stopped
    /// @param colors array to color the mesh by, if any
    /// @param earlier has the mesh of some cells
    bool add_mesh(const StepView& step, CellSet& set, std::uint64_t room,
                  const std::optional<ColorSource>& colors, const EarlierMesh& earlier,
                  const std::stop_token& stop) {
        if (set.ids.empty() || least_mesh_bytes(set.ids.size()) > room)
            return true;
        const auto started = std::chrono::steady_clock::now();
        CellMesh mesh;
        if (!layers_.make_mesh(step, set, mesh, stop, {colors ? &*colors : nullptr}, earlier))
            return false;
        if (bytes_of(mesh) <= room)
            set.mesh = std::make_shared<const CellMesh>(std::move(mesh));
        set.shading_time += std::chrono::steady_clock::now() - started;
        return true;
    }

    /// Adds the blocks and the colors. @return false when stopped
    /// @param known colors that cells may take over
    bool fill(const StepView& step, Extraction& result, const KnownColors& known,
              const std::stop_token& stop) {
        const auto started = std::chrono::steady_clock::now();
        BlockGatherer& gatherer = gatherer_of(step);
        const BlockLevels levels = values_of(step).levels(result.query.isovalues);
        result.levels = levels.units;
        result.blocks = gatherer.none();
        if (result.cells() == 0) // avoids loading the step, which may decode a file
            return true;
        for (const CellSet& surface : result.surfaces)
            gatherer.need(surface);
        if (!gatherer.gather(step, levels, result.blocks, stop,
                             at_hand_.blocks(!gatherer.without_levels())))
            return false;
        find_surroundings(step, result, stop);
        result.gather_time = std::chrono::steady_clock::now() - started;
        if (!colors_.fill(result.query, result.surfaces, step, result.colors, result.corner_colors,
                          stop, known))
            return false;
        if (by_first_crossing(result.query.coloring) && !result.colors.empty())
            color_meshes_by_cells(result);
        return true;
    }

    /// What is known of cells alone: their vertices get the color of the first cell that has them.
    static void color_meshes_by_cells(Extraction& result) {
        std::span<const std::uint16_t> colors = result.colors;
        for (CellSet& surface : result.surfaces) {
            if (surface.mesh) {
                auto colored = std::make_shared<CellMesh>(*surface.mesh);
                color_by_cells(*colored, colors.first(surface.ids.size()));
                surface.mesh = std::move(colored);
            }
            colors = colors.subspan(surface.ids.size());
        }
    }

    /// In the finest level of detail that is small enough, so that little has to be read.
    void find_surroundings(const StepView& step, Extraction& result,
                           const std::stop_token& stop) const {
        const SurfacesQuery& query = result.query;
        std::size_t level = 0;
        const auto small = [&] {
            return std::ranges::max(file_->chunks(level).info().grid.vertices) <= kMostPlaces;
        };
        while (level + 1 < file_->detail_levels() && !small())
            ++level;
        if (level == 0 && step.by_chunks() && !small())
            return;
        const ChunkStore& store = file_->chunks(level);
        const SurroundingField* const known = result.coarse() ? nullptr : at_hand_.surroundings();
        PlaneRange changed;
        if (known) {
            result.surroundings = *known;
            changed = changed_planes(store, query.instant.step, at_hand_.earlier_step());
            if (changed.end == 0)
                return;
        }
        const auto at = [&](std::uint32_t number) {
            return level > 0 ? store.whole(number, stop) : file_->load(number, stop);
        };
        const LoadedStep loaded =
            level == 0 && !step.by_chunks() ? step.whole(stop)
            : step.between() ? BetweenSteps::whole(at(step.at().step), at(step.at().step + 1),
                                                   step.at(), nullptr,
                                                   Blend(store.info().type, store.info().scaling,
                                                         step.at().fraction, query.isovalues))
                             : at(query.instant.step);
        if (known)
            renew_surroundings(result.surroundings, loaded.values, query.instant.step,
                               query.isovalues, changed);
        else
            result.surroundings = surroundings_of(loaded.values, query.instant.step,
                                                  static_cast<unsigned>(level), query.isovalues);
    }

    /// From the first to the last plane of chunks that are not the same at two steps.
    static PlaneRange changed_planes(const ChunkStore& store, std::uint32_t a, std::uint32_t b) {
        PlaneRange planes;
        for (std::uint32_t layer = 0; a != b && layer < store.grid().layers(); ++layer) {
            const ChunkLayerPtr table = store.layer(std::max(a, b), layer);
            if (std::ranges::all_of(table->since,
                                    [&](auto since) { return since <= std::min(a, b); }))
                continue;
            if (planes.end == 0)
                planes.first = layer * kChunkEdge;
            planes.end = std::min((layer + 1) * kChunkEdge, store.info().grid.vertices[2]);
        }
        return planes;
    }

    std::shared_ptr<const IndexFile> file_;
    std::optional<SearchMethod> method_;
    Shading shading_;
    std::vector<SearchInto> searches_; ///< by surface
    std::vector<SearchInto> counts_;   ///< searches for ids alone, by surface
    BlockValues values_;
    BlockGatherer gatherer_;
    BlockValues blended_values_;
    BlockGatherer blended_gatherer_;
    LayerSearch layers_; ///< for meshes
    SurfaceColors colors_;
    DetailSearch details_;
    bool complete_; ///< see `pieces_of`
    ExtractionAtHand at_hand_;
};

} // namespace

Extract extract_from(std::shared_ptr<const IndexFile> file, std::optional<SearchMethod> method,
                     Shading shading) {
    // `std::function` must be copyable, but the state of a search must not be copied.
    auto extracting = std::make_shared<Extracting>(std::move(file), method, shading);
    return [extracting = std::move(extracting)](const SurfacesQuery& query,
                                                const std::stop_token& stop) {
        return (*extracting)(query, stop);
    };
}

Extract extract_from_newest(std::shared_ptr<const NewestIndex> newest, Shading shading) {
    struct Made {
        std::shared_ptr<const IndexFile> file;
        std::shared_ptr<Extracting> extracting;
    };
    return [newest = std::move(newest), shading, made = std::make_shared<Made>()](
               const SurfacesQuery& query, const std::stop_token& stop) {
        if (auto file = array_of(newest->get(), query.array); file != made->file) {
            auto extracting = std::make_shared<Extracting>(file, std::nullopt, shading);
            if (made->extracting)
                extracting->continue_from(*made->extracting);
            *made = {std::move(file), std::move(extracting)};
        }
        return (*made->extracting)(query, stop);
    };
}

} // namespace isochron::index
