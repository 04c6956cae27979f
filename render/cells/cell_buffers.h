// The cells on the GPU: the set that is drawn, and the changes that lead to the next one.
//
//     cells.upload(extractor.newest(), 4 << 20);   // every frame
//     if (cells.shown())
//         pass.draw(view, placement, cells, footprint, appearance);
#pragma once

#include "index/extraction/extraction.h"
#include "render/cells/brick_pool.h"
#include "render/cells/cell_compute.h"
#include "render/cells/mesh_buffers.h"
#include "render/cells/ranked_points.h"
#include "render/cells/slot_plan.h"
#include "render/cells/surroundings.h"
#include "render/cells/upload_count.h"
#include "render/gl/staging_ring.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace isochron::render {

/// When the volume around cells that come with their normals is sent.
enum class SendVolume : std::uint8_t {
    with_cells, ///< they can be drawn as exact surfaces when they are shown
    never       ///< as in motion, when nothing needs it
};

/// A pool of dense slots. A new set comes as the cells that it adds and removes, through a ring of
/// mapped memory within a byte budget per frame, and is applied at once when all of it and of its
/// bricks is on the GPU, so that no frame ever shows half a set. Normals, and what the exact
/// surface is drawn from, are computed there from the bricks; but points that come with the set are
/// taken as they are, all of them: where the processor is the GPU, the worker makes normals in a
/// tenth of the time, and nothing is far.
class CellBuffers {
  public:
    /// @param staging_bytes of the ring, at least twice StagingRing::kUnit; rounded up to units
    CellBuffers(const Gl& gl, const index::Grid& grid, std::size_t staging_bytes = 8 << 20);

    /// What sets for this driver are best asked for with.
    static index::Shading wanted_shading(const Gl& gl);

    /// False where fences are given up, as the driver never passes one.
    bool has_fences() const { return ring_.fences() == Fences::pass; }

    /// Cells that come with their normals, and never change: no set is shown.
    static CellBuffers of_points(const Gl& gl, std::span<const index::CellPoint> points);

    /// Makes and runs once, over no cells, what the first set would have to be computed with:
    /// compiling takes longer than a frame may. Without this the first upload does it.
    /// @param held type of the values in the bricks of all sets
    void prepare(index::ValueType held);

    /// Sends at most `byte_budget` bytes (at least StagingRing::kUnit), fewer where the GPU has not
    /// yet taken what was sent before; never waits for it. A set whose transfer has begun is
    /// finished before a newer one is taken, so that a stream of new sets cannot keep the picture
    /// from ever changing; sets in between are skipped. Null changes nothing.
    /// @param volume never: cells with normals leave it behind. It follows as soon as it is asked
    /// for while no newer set is there.
    /// A set that is larger than the driver's buffers can be is refused, and the last one kept: see
    /// `refused`. Where only its volume is too large, its cells are shown without.
    /// @return true when another set is shown than before
    bool upload(const index::ExtractionPtr& newest, std::size_t byte_budget,
                SendVolume volume = SendVolume::with_cells);

    /// The same for one set, without showing it: the next `upload` of it does.
    /// @return true when everything of it is on the GPU, or it is refused
    bool stage(const index::ExtractionPtr& set, std::size_t byte_budget);

    /// The set that is drawn, null before the first is complete.
    const index::ExtractionPtr& shown() const { return shown_; }
    /// The last set that was too large, null where a later one was not; and why, in one line.
    const index::ExtractionPtr& refused() const { return refused_; }
    const std::string& refusal() const { return refusal_; }
    /// True while a set is on its way to the GPU.
    bool pending() const { return arriving_ != nullptr; }
    /// Grows with every change of the shown set; no two buffers ever have the same, but 0.
    std::uint64_t version() const { return version_; }

    /// Cells drawn; one that several surfaces pass through counts for each.
    std::size_t size() const { return slots_->places.size(); }
    /// Which cell has which slot.
    const Slots& slots() const { return *slots_; }

    /// GL_TEXTURE_BUFFER by slot, one RGB32UI texel: the words of an index::CellPoint.
    GLuint texture() const { return points_.texture(); }

    /// Whether the shown set came with meshes of its surfaces, as `Footprint::mesh` needs.
    bool has_mesh() const { return shown_ && mesh_version_ == version_; }
    const MeshBuffers& mesh() const { return mesh_; }
    /// Of the shown set.
    const Surroundings& surroundings() const { return surroundings_; }

    /// Whether the shown set's part of the volume is on the GPU, as the exact surface needs.
    bool has_volume() const { return volume_version_ == version_; }
    /// Whether it is not, and the driver can hold it.
    bool wants_volume() const;
    /// Computes the two textures below for the shown set, which has its volume, unless they are up
    /// to date.
    /// @throws Error when there are more than `corner_limit()` cells
    void compute_corners();
    /// So many cells can have them: less than can be drawn without.
    std::size_t corner_limit() const { return corner_gradients_.limit(); }
    /// GL_TEXTURE_BUFFER by slot, two RGBA32F texels: the values at the cell's vertices less its
    /// surface's isovalue, in brick units (index/extraction/brick_values.h), which have the same sign and the
    /// same roots. Vertices are in the order 000, 100, 010, 110, 001, 101, 011, 111, x first.
    GLuint corner_values_texture() const { return corner_values_.texture(); }
    /// GL_TEXTURE_BUFFER by slot, four RGBA32UI texels: for each vertex, in the same order, two
    /// words of two halves: (gradient x, y), (gradient z, 0). Gradients are central differences
    /// (one-sided at the border) in physical space, towards lower values, times one factor for the
    /// whole data set; zero where they are not finite.
    GLuint corner_gradients_texture() const { return corner_gradients_.texture(); }

    /// Since the beginning.
    const UploadCount& count() const { return count_; }
    /// Null before the first set.
    const BrickPool* bricks() const { return bricks_ ? &*bricks_ : nullptr; }

  private:
    bool take_up(const index::ExtractionPtr& newest, SendVolume volume, std::size_t bytes,
                 std::size_t& sent);
    bool begin(index::ExtractionPtr set, SendVolume volume);
    bool make_room_for(const index::VolumeBricks& bricks);
    bool send_on(std::size_t bytes, std::size_t& sent);
    bool send_mesh(std::size_t bytes, std::size_t& sent);
    bool send_bricks(std::size_t bytes, std::size_t& sent);
    void send_volume_of_shown(std::size_t bytes, std::size_t& sent);
    bool send_message(std::size_t bytes, std::size_t& sent);
    bool send_styles(std::size_t bytes, std::size_t& sent);
    Slots write_points();
    Slots place_cells();
    void show();

    const Gl* gl_;
    index::Grid grid_;
    StagingRing ring_;
    DeviceArray points_, message_, styles_, corner_values_, corner_gradients_;
    MeshBuffers mesh_;
    Surroundings surroundings_;
    std::optional<BrickPool> bricks_;    ///< made when the type is known
    std::optional<CellCompute> compute_; ///< likewise
    index::ExtractionPtr shown_, refused_;
    std::string refusal_;
    std::shared_ptr<const Slots> slots_ = std::make_shared<Slots>(); ///< of the shown set
    std::uint64_t version_ = 0, corners_version_ = 0, volume_version_ = 0, mesh_version_ = 0;
    UploadCount count_;
    bool sending_mesh_ = false;   ///< of the set on its way
    bool sending_bricks_ = false; ///< of the set on its way, or of the shown one after it
    // The set on its way:
    index::ExtractionPtr arriving_;
    std::unique_ptr<RankedPoints> ranked_; ///< where its points come with it,
    std::unique_ptr<SlotPlan> plan_;       ///< else
    bool merged_ = false;
    std::size_t words_sent_ = 0, styles_sent_ = 0;
};

} // namespace isochron::render
