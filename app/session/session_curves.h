// The curves of a session: those of the surfaces that it shows, the values at its mark, and those
// along its ruler.
#pragma once

#include "app/choice/frame.h"
#include "app/frame/asker.h"
#include "app/frame/background_work.h"
#include "app/panel/panel_model.h"
#include "app/session/curve_maker.h"
#include "app/session/shown_arrays.h"
#include "index/extraction/extractor.h"
#include "index/extraction/profile.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// The place whose values over time are a curve: that of the mark.
std::optional<glm::dvec3> marked_place(const interaction::Settings& settings);

/// Where curves are written.
struct CurveFolders {
    std::optional<std::filesystem::path> kept; ///< folder of KeptCurves; none: no curve is kept
    std::filesystem::path tables;              ///< unless the user chooses another one
};

class SessionCurves {
  public:
    explicit SessionCurves(CurveMaker::Measure measure = measured_in_index());

    /// Sets the function that is called, on any thread, when there is something new.
    void set_wake(const std::function<void()>& wake);
    /// Before the first `update`; without it nothing is kept, and no table offered.
    void write_to(CurveFolders folders);

    /// Called once a frame, once the picture's cells are asked for: curves wait while these come. They
    /// are made while their drawer is open.
    void update(const Frame& frame, const ShownArrays& arrays, const index::Extractor& extractor);
    /// What the panel shows. @param state of the last `update`; lives as long as what is returned
    PanelCurves in_panel(const ExplorerState& state);
    /// The tables that were written since the last call, or why they were not.
    std::vector<std::string> messages() { return writing_.messages(); }

  private:
    struct Profiled {
        index::ProfileQuery query;
        index::ProfilePtr profile; ///< null: it could not be made
        std::string failure;       ///< why
    };
    void update_profile(const Frame& frame, const ShownArrays& arrays, bool seen);
    void save(const ExplorerState& state);
    std::vector<StepCurvePtr> shown(bool of_mark);

    std::optional<CurveFolders> folders_;
    std::vector<std::optional<std::size_t>> of_surface_; ///< number of each surface's curve
    std::optional<std::size_t> of_mark_;
    bool only_whole_ = false; ///< curves that grow differ from wall to wall
    CurveMaker maker_;
    Profiled profiled_;                                   ///< the last one
    bool profile_wanted_ = false, profile_comes_ = false; ///< a panel shows it; it is being made
    Asker<index::ProfileQuery, Profiled> profiling_;
    BackgroundWork writing_;
};

} // namespace isochron::app
