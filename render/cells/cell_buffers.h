// The cells on the GPU: the shown set, and the upload of the next one.
//
//     cells.upload(extractor.newest(), 4 << 20);   // every frame
//     if (cells.shown())
//         pass.draw(view, placement, cells, footprint, appearance);
#pragma once

#include "index/extraction/extraction.h"
#include "render/cells/arriving_set.h"
#include "render/cells/axis_table.h"
#include "render/cells/block_pool.h"
#include "render/cells/cell_compute.h"
#include "render/cells/mesh_buffers.h"
#include "render/cells/slot_assignment.h"
#include "render/cells/surroundings.h"
#include "render/cells/upload_count.h"
#include "render/gl/staging_ring.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace isochron::render {

/// Whether the volume around cells that come with their normals is sent.
enum class SendVolume : std::uint8_t {
    with_cells, ///< with the cells, which then can be drawn as exact surfaces at once
    never       ///< not now: in motion nothing needs it
};

/// Cells lie in dense slots. A new set is sent as its difference from the shown one, through a ring
/// of mapped memory, with a budget of bytes per frame. It is applied when all of it and of its
/// volume blocks is on the GPU, so that no frame shows half a set. The GPU computes normals, and
/// the data for exact surfaces, from the blocks. A set that comes with its points, normals
/// included, is sent whole instead: for software GL, where the worker computes normals in a tenth
/// of the time and sending costs little.
class CellBuffers {
  public:
    /// @param staging_bytes size of the ring, at least twice StagingRing::kUnit; rounded up to
    /// units
    CellBuffers(const Gl& gl, const index::Grid& grid, std::size_t staging_bytes = 8 << 20);

    /// The shading with which sets for this driver should be extracted.
    static index::Shading wanted_shading(const Gl& gl);

    /// False if fences are not used, because this driver never passes one.
    bool has_fences() const { return ring_.fences() == Fences::pass; }

    /// Fixed cells from points with normals; `shown()` is null.
    /// @param grid of the cells; a regular grid need not be given
    /// @param largest cell [voxels] if the points are of mixed levels of detail; else 0
    static CellBuffers of_points(const Gl& gl, std::span<const index::CellPoint> points,
                                 const index::Grid& grid = {.vertices = {2, 2, 2}},
                                 std::uint32_t largest = 0);

    /// Makes the compute programs and runs each once, over no cells: compiling them takes longer
    /// than a frame may. Without this the first upload does it.
    /// @param held type of the values in volume blocks. If the arrays of an index have several
    ///        types, call this for each of them.
    void prepare(index::ValueType held);

    /// Sends at most `byte_budget` bytes (at least StagingRing::kUnit), fewer if the GPU has not
    /// yet copied what was sent before; never waits. A set whose transfer has begun is completed
    /// before a newer one begins, so that the picture still changes in a stream of new sets; sets
    /// in between are skipped. A set that is too large for the driver's buffers or memory is
    /// refused, and the last one stays: see `refused`. If only its volume is too large, its cells
    /// are shown without it.
    /// @param newest null changes nothing
    /// @param volume `never`: cells with normals are shown without their volume. It follows with a
    /// later call that asks for it and has no newer set.
    /// @return true when another set is shown than before
    bool upload(const index::ExtractionPtr& newest, std::size_t byte_budget,
                SendVolume volume = SendVolume::with_cells);

    /// Sends each set whole from now on, also where its changes are less: the order in which cells
    /// are drawn, which decides where two are equally near, then does not depend on earlier sets.
    void send_whole() { by_changes_ = false; }

    /// Stages one set like `upload`, without showing it; the next `upload` of this set shows it.
    /// @return true when it is completely on the GPU, or refused
    bool stage(const index::ExtractionPtr& set, std::size_t byte_budget);

    /// The set that is drawn; null before the first is complete.
    const index::ExtractionPtr& shown() const { return shown_; }
    /// The newest set if it was refused, else null; and why, in one line.
    const index::ExtractionPtr& refused() const { return refused_.set; }
    const std::string& refusal() const { return refused_.why; }
    /// True while a set is on its way to the GPU.
    bool pending() const { return arriving_.set() != nullptr; }
    /// Changes with the shown set. Different buffers never have the same version, except 0.
    std::uint64_t version() const { return version_; }

    /// Number of drawn cells; a cell counts once for each surface that passes through it.
    std::size_t size() const { return slots_->places.size(); }
    /// The slot of each cell.
    const Slots& slots() const { return *slots_; }

    /// GL_TEXTURE_BUFFER by slot, one RGB32UI texel each: the words of an index::CellPoint.
    GLuint texture() const { return points_.texture(); }

    /// Whether the shown set came with meshes of its surfaces, as `Footprint::mesh` needs. Those of
    /// a level (index/extraction/simplified_meshes.h) above 0 come with a later `upload`.
    bool has_mesh(std::size_t level = 0) const {
        return shown_ && meshes_[level].version == version_;
    }
    const MeshBuffers& mesh(std::size_t level = 0) const { return meshes_[level].buffers; }
    const AxisTable& axes() const { return *axes_; }
    /// Surroundings of the shown set.
    const Surroundings& surroundings() const { return surroundings_; }

    /// Whether the shown set's part of the volume is on the GPU, as the exact surface needs.
    bool has_volume() const { return volume_version_ == version_; }
    /// Whether the volume is not on the GPU, but the driver can hold it.
    bool wants_volume() const;
    /// Computes the two textures below for the shown set, unless they are up to date. The set's
    /// volume must be on the GPU.
    /// @throws Error when there are more than `corner_limit()` cells
    void compute_corners() { compute_corners(std::numeric_limits<std::size_t>::max()); }
    /// Computes in pieces, of at most so many cells. @return how many cells it was; 0: none is left
    std::size_t compute_corners(std::size_t most);
    /// Computes the corners of some cells, into arrays of the caller.
    /// @param cells slots in use, or numbers in the list; the set's volume is on the GPU
    void write_corners(DrawPart cells, const CellCompute::Corners& to) const;
    static DeviceArray corner_values_array(const Gl& gl);
    static DeviceArray corner_gradients_array(const Gl& gl);
    static DeviceArray corner_colors_array(const Gl& gl);
    /// Most cells that these textures can hold: fewer than can be drawn without them.
    std::size_t corner_limit() const { return corners_.gradients.limit(); }
    /// GL_TEXTURE_BUFFER by slot, two RGBA32F texels each: the values at the cell's vertices minus
    /// its surface's isovalue, in block units (index/extraction/block_values.h), which keep signs
    /// and roots. Order of the vertices: 000, 100, 010, 110, 001, 101, 011, 111, x first.
    GLuint corner_values_texture() const { return corners_.values.texture(); }
    /// GL_TEXTURE_BUFFER by slot, four RGBA32UI texels each: for each vertex, in the same order,
    /// two words of two halves: (gradient x, y), (gradient z, 0). Gradients are central differences
    /// (one-sided at the border) in physical space, towards lower values, times one factor for the
    /// whole data set; zero if they are not finite.
    GLuint corner_gradients_texture() const { return corners_.gradients.texture(); }

    /// GL_TEXTURE_BUFFER by slot, one RGBA32UI texel each: Extraction::corner_colors; 0: none.
    GLuint corner_colors_texture() const {
        return shown_ && !shown_->corner_colors.empty() ? corner_colors_.texture() : 0;
    }

    /// What was sent so far.
    const UploadCount& count() const { return count_; }
    /// Null before the first set.
    const BlockPool* blocks() const { return blocks_ ? &*blocks_ : nullptr; }

  private:
    /// What is kept for exact surfaces: see the textures.
    struct KeptCorners {
        DeviceArray values, gradients;
        std::uint64_t version = 0; ///< version of the set whose corners they are
        std::size_t done = 0;      ///< cells
    };
    struct KeptMeshes {
        MeshBuffers buffers;
        std::uint64_t version = 0; ///< version of the set whose meshes they are
        /// Meshes of the arriving set, or later ones of the shown set, are being sent.
        bool sending = false;
    };
    struct Refusal {
        index::ExtractionPtr set; ///< null: none
        std::string why;
    };

    void hold(index::ValueType held);
    void give_up(const index::ExtractionPtr& set, const OutOfMemory& why);
    bool take_up(const index::ExtractionPtr& newest, SendVolume volume, SendBudget& budget);
    bool begin(index::ExtractionPtr set, SendVolume volume);
    bool make_room_for(const index::VolumeBlocks& blocks);
    bool send_on(SendBudget& budget);
    bool send_mesh(std::size_t level, SendBudget& budget);
    void send_later_meshes(SendBudget& budget);
    bool send_blocks(SendBudget& budget);
    bool send_colors(const index::Extraction& set, const Slots& slots, bool ranked,
                     SendBudget& budget);
    void send_volume_of_shown(SendBudget& budget);
    Slots place_cells();
    void show();

    const Gl* gl_;
    index::Grid grid_;
    std::unique_ptr<const AxisTable> axes_;
    StagingRing ring_;
    DeviceArray points_;
    KeptCorners corners_;
    /// Colors of the shown volume's cells; of the next one.
    DeviceArray corner_colors_, arriving_colors_;
    /// Colors that are being sent, where slots are not ranks.
    std::vector<std::uint16_t> colors_by_slot_;
    std::size_t colors_sent_ = 0;                       ///< cells
    std::array<KeptMeshes, index::kMeshLevels> meshes_; ///< by level
    Surroundings surroundings_;
    std::optional<BlockPool> blocks_;                  ///< made when the type is known
    index::ValueType held_{};                          ///< type of the blocks' values
    std::map<index::ValueType, CellCompute> computes_; ///< by type of the values
    CellCompute* compute_ = nullptr;                   ///< for `held_`; likewise
    bool by_changes_ = true;                           ///< else each set is sent whole
    index::ExtractionPtr shown_;
    Refusal refused_;
    std::shared_ptr<const Slots> slots_ = std::make_shared<Slots>(); ///< slots of the shown set
    std::uint64_t version_ = 0, volume_version_ = 0;
    std::uint64_t no_volume_version_ = 0; ///< version of the set whose volume found no memory
    UploadCount count_;
    ArrivingSet arriving_;
    /// Blocks of the arriving set, or later ones of the shown set, are being sent.
    bool sending_blocks_ = false;
};

} // namespace isochron::render
