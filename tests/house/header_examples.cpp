// Compiles the example of every header, so that none of them rots. Each stands in a function whose
// parameters are what the example takes for granted; none of them is ever called.
//
// A new example needs a few lines here; house_tests says which one is missing.
#include "app/command_line/command_line.h"
#include "app/config/config_fields.h"
#include "app/explore/cluster_job.h"
#include "app/explore/exploration.h"
#include "app/frame/asker.h"
#include "app/frame/history.h"
#include "app/kept/session_file.h"
#include "app/loop/live_loop.h"
#include "app/loop/live_recording.h"
#include "app/output/kept_pictures.h"
#include "app/output/movie_file.h"
#include "app/output/outputs.h"
#include "app/panel/panel_in_room.h"
#include "app/quality/draw_meter.h"
#include "app/quality/frame_quality.h"
#include "app/quality/quality_controller.h"
#include "app/scene/scene.h"
#include "app/session/session.h"
#include "index/detail/cell_thinning.h"
#include "index/export/surface_writer.h"
#include "index/extraction/cell_ray.h"
#include "index/extraction/extractor.h"
#include "index/extraction/instant_surfaces.h"
#include "index/extraction/slice_values.h"
#include "index/file/index_file.h"
#include "index/file/step_view.h"
#include "index/indexing/level_chooser.h"
#include "index/measure/measures.h"
#include "index/measure/vertex_sides.h"
#include "index/paper/thi_tree.h"
#include "index/readers/formats/foreign_file.h"
#include "index/readers/formats/format.h"
#include "index/readers/formats/series/series_writer.h"
#include "index/readers/process/reader_messages.h"
#include "index/scan/bricks.h"
#include "index/search/layer_search.h"
#include "index/search/surface_mesh.h"
#include "index/surface/mesh_clusters.h"
#include "index/volume/level_map.h"
#include "index/volume/order_key.h"
#include "interaction/command_fields.h"
#include "interaction/controls/desktop_emulation.h"
#include "interaction/controls/motion_gate.h"
#include "interaction/controls/panel_pointer.h"
#include "interaction/enum_names.h"
#include "interaction/recording/key_film.h"
#include "interaction/recording/recording.h"
#include "interaction/tools/tool.h"
#include "interaction/trackers/pose_filter.h"
#include "render/cells/cell_buffers.h"
#include "render/drawing/cell_pass.h"
#include "render/drawing/ghost_pass.h"
#include "render/gl/gl.h"
#include "render/gl/gpu_timer.h"
#include "render/gl/render_target.h"
#include "render/passes/panel_picture.h"
#include "render/passes/text_pass.h"
#include "stereo/cluster.h"
#include "stereo/context/gl_context.h"
#include "stereo/context/wake.h"
#include "stereo/display.h"
#include "stereo/headset.h"
#include "stereo/screen.h"
#include "stereo/windows.h"
#include "tests/support/drawing/image_compare.h"
#include "tests/support/played_headset/played_headset.h"

#include <gmock/gmock.h>

// The examples' own names for what they do with their results.
namespace {

template <class... Any>
void use(const Any&...) {}
template <class... Any>
void show(const Any&...) {}
template <class... Any>
void search(const Any&...) {}
template <class... Any>
void draw(const Any&...) {}
template <class... Any>
void write(const Any&...) {}
template <class... Any>
void mark(const Any&...) {}
template <class... Any>
void navigate(const Any&...) {}
template <class... Any>
void note(const Any&...) {}
void draw_triangles() {}
void open_files_and_windows() {}
void show_frames() {}
void run_the_program() {}

} // namespace

namespace isochron::index {
namespace {

void level_choice_example(ValueType type, std::span<const std::byte> stored) {
#include "index/indexing/level_chooser.example"
}

void mesh_clusters_example(const CellMesh& mesh, const std::stop_token& stop) {
#include "index/surface/mesh_clusters.example"
}

void cell_thinning_example(std::vector<CellPoint> cells, std::uint64_t most) {
#include "index/detail/cell_thinning.example"
}

void cell_ray_example(const ExtractionPtr& shown, const Grid& grid, glm::dvec3 wand,
                      glm::dvec3 ahead) {
#include "index/extraction/cell_ray.example"
}

void slice_values_example(const IndexFile& array, const glm::dvec3& at) {
#include "index/extraction/slice_values.example"
}

void instant_surfaces_example(const std::shared_ptr<const IndexFile>& file, std::uint32_t step,
                              double isovalue, void (*draw)(const CellMesh&)) {
#include "index/extraction/instant_surfaces.example"
}

void extractor_example(const std::shared_ptr<const IndexFile>& file, std::uint32_t step,
                       double isovalue) {
#include "index/extraction/extractor.example"
}

void format_example(const ReadOptions& options) {
#include "index/readers/formats/format.example"
}

void series_writer_example(const std::filesystem::path& dir, const SeriesInfo& info,
                           std::size_t steps, const std::vector<float>& (*values_of)(std::size_t),
                           double (*time_of)(std::size_t)) {
#include "index/readers/formats/series/series_writer.example"
}

void reader_messages_example() {
#include "index/readers/process/reader_messages.example"
}

void bricks_example(const StepValues& values, const LevelMap& levels, std::uint32_t step,
                    double isovalue, std::vector<CellId>& ids) {
#include "index/scan/bricks.example"
}

void step_view_example(const std::shared_ptr<const IndexFile>& file, const Query& query,
                       CellSet& set) {
#include "index/file/step_view.example"
}

void surface_writer_example(const ExportPlan& plan,
                            const std::function<ExportedStep(std::uint32_t)>& exported) {
#include "index/export/surface_writer.example"
}

void surface_mesh_example(const std::shared_ptr<const IndexFile>& file, std::uint32_t step,
                          double isovalue) {
#include "index/search/surface_mesh.example"
}

void add_row(std::string_view, double) {}
void measures_example(const std::shared_ptr<const IndexFile>& file, std::uint32_t step,
                      double isovalue) {
#include "index/measure/measures.example"
}

void vertex_sides_example(const CellMesh& mesh, const Grid& grid, std::uint32_t y, std::uint32_t z,
                          std::uint64_t count) {
#include "index/measure/vertex_sides.example"
}

void thi_tree_example(const StepValues& values, const KeyMap& keys, std::uint32_t step,
                      double isovalue) {
#include "index/paper/thi_tree.example"
}

void level_map_example(const StepValues& values, std::size_t t, double isovalue,
                       std::span<std::uint8_t> ranks) {
#include "index/volume/level_map.example"
}

} // namespace
} // namespace isochron::index

namespace isochron::interaction {
namespace {

void command_fields_example(Commands& commands, const Commands& others) {
#include "interaction/command_fields.example"
}

} // namespace

enum class Hand : std::uint8_t { left, right };
#include "interaction/enum_names.example"

namespace {

void panel_pointer_example(PanelPointer& pointer, const InputState& input,
                           const TouchedPanel& panel) {
#include "interaction/controls/panel_pointer.example"
}

void key_film_example(const std::string& text, const Settings& settings, const InputState& devices,
                      const StepTimes& times, Recording& recording) {
#include "interaction/recording/key_film.example"
}

void tool_example(Tool& tool, std::span<const ToolHand> hands, const ToolContext& now,
                  Commands& commands) {
#include "interaction/tools/tool.example"
}

void pose_filter_example(Seconds now, const Pose& pose) {
#include "interaction/trackers/pose_filter.example"
}

} // namespace
} // namespace isochron::interaction

namespace isochron::render {
namespace {

void cell_buffers_example(CellBuffers& cells, const index::Extractor& extractor, CellPass& pass,
                          const View& view, const Placement& placement, Footprint footprint,
                          const CellAppearance& appearance) {
#include "render/cells/cell_buffers.example"
}

void ghost_pass_example(GhostPass& pass, std::span<const GhostMesh> ghosts, const View& view,
                        const Placement& placement, float opacity,
                        const CellAppearance& appearance) {
#include "render/drawing/ghost_pass.example"
}

void gl_example(const stereo::GlContext& context) {
#include "render/gl/gl.example"
}

void gpu_timer_example(GpuTimer& timer, std::uint64_t frame) {
    using Clock = GpuTimer::Clock;
#include "render/gl/gpu_timer.example"
}

void render_target_example(const Gl& gl, const View& view) {
    struct {
        void draw(const View&) {}
    } pass;
#include "render/gl/render_target.example"
}

void panel_picture_example(const Gl& gl) {
#include "render/passes/panel_picture.example"
}

void text_pass_example(const Gl& gl, const Font& font, const View& view,
                       const glm::mat4& room_from_index) {
#include "render/passes/text_pass.example"
}

} // namespace
} // namespace isochron::render

namespace isochron::stereo {
namespace {

void cluster_example(index::Team* team, std::vector<std::byte> order,
                     std::span<const std::byte> mine) {
#include "stereo/cluster.example"
}

void display_example(const render::Gl& gl, const std::unique_ptr<GlContext>& context,
                     const Installation& installation, const interaction::Pose& head,
                     const Display::Overlay& draw_panel) {
    struct {
        void draw(std::span<const render::View>) {}
    } pass;
#include "stereo/display.example"
}

void headset_example(const std::unique_ptr<Headset>& headset, interaction::Seconds now,
                     float near_plane, float far_plane, const HeadsetPictures& pictures) {
#include "stereo/headset.example"
}

void screen_example(const Screen& screen, const interaction::Pose& head) {
#include "stereo/screen.example"
}

void wake_example(const Windows& windows) {
    using interaction::Seconds;
    struct {
        void set_wake(const std::function<void()>&) {}
    } worker;
#include "stereo/context/wake.example"
}

void windows_example(const Installation& installation) {
#include "stereo/windows.example"
}

} // namespace
} // namespace isochron::stereo

namespace isochron::app {
namespace {

void cluster_job_example(const std::string& hash) {
#include "app/explore/cluster_job.example"
}

void exploration_example(const ExploreOptions& options) {
#include "app/explore/exploration.example"
}

void run_verify(const std::filesystem::path&) {}
#include "app/command_line/command_line.example"

void frame_quality_example(FrameQuality& quality, FrameLog& log, const ExplorerState& state,
                           bool changed, const render::FootprintSet& footprints,
                           const render::FootprintSet& possible, FrameReport& report,
                           std::span<const render::View> views, const DrawLoad& of_cell,
                           Milliseconds processor_time) {
#include "app/quality/frame_quality.example"
}

template <class Use>
void config_fields_example(Use use, Config& config) {
#include "app/config/config_fields.example"
}

void picture_state_example(const QualityChoice& choice, bool moves_exact, bool sways,
                           bool finer_cells_wait) {
#include "app/quality/picture_state.example"
}

void quality_controller_example(DrawMeter& meter, const interaction::MotionGate& gate) {
#include "app/quality/quality_controller.example"
}

void kept_pictures_example(const render::Gl& gl, const stereo::Windows& windows,
                           const Config& config, std::deque<stereo::Display>& displays,
                           std::optional<RoomView>& room,
                           std::span<const stereo::ViewerPose> viewers, stereo::StereoMode mode,
                           const stereo::DrawViews& scene) {
#include "app/output/kept_pictures.example"
}

void outputs_example(const Config& config, stereo::Windows windows, const Audience& audience,
                     const Outputs::Scene& scene, const Outputs::Overlay& panel,
                     const interaction::InputState& input, const PictureNote& note) {
#include "app/output/outputs.example"
}

void history_example(History& history, const ExplorerState& before, const ExplorerState& after,
                     interaction::Commands& commands, const interaction::InputState& input) {
#include "app/frame/history.example"
}

void asker_example(Asker<index::Instant, std::string>::Answering words_of,
                   Asker<index::Instant, std::string>::Failing why_not,
                   const std::function<void()>& wake, std::vector<std::string>& messages) {
#include "app/frame/asker.example"
}

void movie_file_example(const render::Image& image) {
#include "app/output/movie_file.example"
}

void session_file_example(const std::filesystem::path& path, const std::string& data,
                          const std::string& hash, Session& session,
                          const interaction::StandingPlace& head, std::size_t steps) {
#include "app/kept/session_file.example"
}

void live_loop_example(const Config& config, interaction::CompositeInput trackers, Session& session,
                       const std::shared_ptr<LiveRecording>& recording) {
#include "app/loop/live_loop.example"
}

void panel_in_room_example(PanelInRoom& panel, Picture& picture,
                           const interaction::InputState& input, const ExplorerState& state,
                           const PanelModel& model,
                           interaction::Commands (*commands_of)(const interaction::InputState&,
                                                                const interaction::Commands&)) {
#include "app/panel/panel_in_room.example"
}

void cell_sets_example(CellSets& sets, const index::ExtractionPtr& newest, bool rests,
                       const index::SurfacesQuery& surfaces,
                       void (*draw)(const render::CellBuffers&)) {
#include "app/scene/cell_sets.example"
}

void cell_supply_example(CellSupply& supply, const Frame& frame, Picture& picture,
                         const PictureMaker& pictures, const FrameQuality& quality,
                         FramePlan& plan) {
#include "app/choice/cell_supply.example"
}

void scene_example(Scene& scene, const index::ExtractionPtr& newest, const Picture& picture,
                   std::span<const render::View> views) {
#include "app/scene/scene.example"
}

struct SteadySeconds {
    interaction::Seconds now() const { return {}; }
};
void session_example(const Config& config, const std::shared_ptr<const index::IndexFile>& file,
                     const std::unique_ptr<stereo::GlContext>& context,
                     interaction::DesktopEmulation& emulation, const SteadySeconds& clock) {
#include "app/session/session.example"
}

} // namespace
} // namespace isochron::app

namespace isochron::test_support {
namespace {

void image_compare_example(const render::Image& picture, const render::Image& expected) {
#include "tests/support/drawing/image_compare.example"
}

} // namespace
} // namespace isochron::test_support

namespace isochron::played {
namespace {

void played_headset_example(const render::Image& expected) {
    using test_support::images_match;
    using testing::IsEmpty;
#include "tests/support/played_headset/played_headset.example"
}

} // namespace
} // namespace isochron::played
