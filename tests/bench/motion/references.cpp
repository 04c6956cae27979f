// Draws settled pictures, frame by frame, as a replay does.
#include "tests/bench/motion/references.h"

#include "app/loop/replay.h"
#include "stereo/context/gl_context.h"

#include <algorithm>
#include <limits>

namespace isochron::bench {
namespace {

/// A session that waits for the cells of each picture and draws it at its best.
class StillSession {
  public:
    StillSession(const app::Config& config, std::shared_ptr<const index::IndexFile> file)
        : config_(config), context_(stereo::make_context(
                               config.rendering.context,
                               {.size = config.installation.windows.front().size, .vsync = false})),
          session_(config_, std::move(file), *context_) {}

    std::vector<render::Image> picture(const app::ExplorerState& state,
                                       const std::vector<interaction::DeviceState>& devices) {
        session_.set_state(state);
        // The picture settles when nothing has happened for a while.
        constexpr int kMostFrames = 4;
        for (int i = 0; i < kMostFrames; ++i) {
            const app::FrameReport& report =
                session_.frame({interaction::Seconds(time_), devices}, {}, app::Waiting::for_cells);
            app::expect_cells(session_);
            time_ += kWhile;
            if (report.pace == interaction::Pace::settled && report.final)
                return shown_by(session_);
        }
        throw index::Error("a picture to compare with did not settle");
    }

  private:
    static constexpr double kWhile = 10; ///< [s]
    const app::Config config_;
    std::unique_ptr<stereo::GlContext> context_;
    app::Session session_;
    double time_ = 0;
};

/// The state with isovalues that no value reaches.
app::ExplorerState without_cells(app::ExplorerState state, const index::IndexFile& file) {
    const index::IndexStats& stats = file.stats();
    for (interaction::Isosurface& surface : state.isosurfaces)
        surface.isovalue = stats.high + (stats.high - stats.low) + 1;
    return state;
}

} // namespace

const Reference& References::wanted(const ShownPicture& picture) {
    const auto same = [&](const Reference& reference) {
        return reference.state == picture.state && reference.devices == picture.input.devices;
    };
    const auto found = std::ranges::find_if(references_, same);
    if (found != references_.end())
        return *found;
    references_.push_back({picture.state, picture.input.devices, {}, {}});
    return references_.back();
}

void References::make() {
    const auto of_all = [this](std::vector<render::Image> Reference::*pictures, auto&& state_of) {
        StillSession session(config_, file_);
        for (Reference& reference : references_) {
            check_();
            if ((reference.*pictures).empty())
                reference.*pictures = session.picture(state_of(reference), reference.devices);
        }
    };
    of_all(&Reference::settled, [](const Reference& reference) { return reference.state; });
    of_all(&Reference::without,
           [this](const Reference& reference) { return without_cells(reference.state, *file_); });
}

} // namespace isochron::bench
