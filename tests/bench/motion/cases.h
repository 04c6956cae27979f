// The cases of the motion benchmark: data, a picture's size, a budget and motions.
#pragma once

#include "tests/bench/motion/data.h"
#include "tests/bench/motion/play.h"
#include "tests/bench/motion/script.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace isochron::bench {

/// All that is played in pictures of one size on the same data.
struct MotionCase {
    MovedData data;
    glm::ivec2 size{1280, 720}; ///< size of the window
    int eyes = 1;
    std::vector<double> budgets; ///< [ms]; of a window it chooses by itself: one
    std::vector<Motion> motions;
    bool window = false; ///< on the display, with what the program has by default
};

/// Stands for what a window has by default, one period of its display.
constexpr double kBudgetOfWindow = 0;

struct CaseOptions {
    std::vector<std::string> data = moved_names();
    std::vector<Motion> motions = {}; ///< empty: all that a case has
    std::vector<double> budgets = {}; ///< empty: all that a case has
    bool full = false;
};
std::vector<MotionCase> cases_of(const CaseOptions& options);

/// A motion beside its settled pictures.
struct ComparedMotion {
    MotionRow row;
    render::Image moving, settled; ///< the least alike
};
/// Plays a case. @param kept folder of indices @param check called often; may throw
std::vector<ComparedMotion> play_case(const MotionCase& of, const std::filesystem::path& kept,
                                      const PlayOptions& options,
                                      const std::function<void()>& check,
                                      const index::Progress& progress);

/// Pictures of motions, moving above settled, side by side. @param width of each [pixel]
render::Image sheet_of(const std::vector<ComparedMotion>& motions, int width);
/// Sheets, one below the other.
render::Image stacked(const std::vector<render::Image>& sheets);

} // namespace isochron::bench
