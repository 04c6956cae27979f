// A session with more cells than fit into a frame, for tests of levels of detail.
#pragma once

#include "tests/support/eventually.h"
#include "tests/support/memory_series.h"
#include "tests/support/session_fixture.h"

#include <cmath>
#include <cstdint>
#include <memory>

namespace isochron::app {

inline constexpr std::uint64_t kFew = 1 << 14; ///< cells: less than a third of those of `large_`

class SessionDetail : public SessionTest {
  protected:
    SessionDetail()
        : waves_({97, 97, 97}, 1, index::ValueType::f32, [](double x, double y, double z, double) {
              return std::sin(x / 3) + std::sin(y / 3) + std::sin(z / 3);
          }) {
        index::MemorySeries series(waves_.view());
        build_index(series, folder_.path() / "waves.isochron", {});
        large_ = index::IndexFile::open(folder_.path() / "waves.isochron");
    }
    static Config config_with(double budget_ms) {
        Config config = small_config();
        config.quality.frame_budget_ms = budget_ms;
        config.quality.still_budget_ms = 10'000;
        return config;
    }
    /// As a session extracts, unless it is told otherwise.
    index::Extract extract() const {
        const render::Gl gl(context_->loader());
        return index::extract_from(large_, std::nullopt, render::CellBuffers::wanted_shading(gl));
    }
    /// A head at rest, or one that sways too slowly to be moving.
    FrameReport frame(Session& session, bool sways, const interaction::Commands& commands = {}) {
        interaction::InputState input = head_at_rest(frame_ / 60.0);
        if (sways)
            input.devices[0].pose->position.x = 1e-5f * static_cast<float>(frame_ / 2 % 2);
        ++frame_;
        return session.frame(input, commands, Waiting::never);
    }
    /// Makes the first frame, which asks for a surface of 181,157 cells.
    FrameReport first_frame(Session& session, bool sways) {
        interaction::Commands first;
        first.isovalue = 0.1;
        return frame(session, sways, first);
    }

    index::TestField waves_;
    std::shared_ptr<const index::IndexFile> large_;
    int frame_ = 0;
};

} // namespace isochron::app
