// The file of a timing report: a row for each frame, written while frames are made, and then the summary.
#pragma once

#include "app/frame/background_work.h"
#include "app/frame/frame_report.h"
#include "index/system/new_file.h"
#include "render/cells/footprints.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace isochron::app {

nlohmann::json json_of(const render::UploadCount& count);

/// Writes JSON on a thread of its own, so that no frame waits for the disk, and holds some rows at a
/// time. The file appears under its name when it is complete.
class FrameRows {
  public:
    /// @throws index::Error when the file cannot be made
    explicit FrameRows(const std::filesystem::path& path) : file_(path) {}

    /// Takes the next frame, when everything is known of it.
    void add(const FrameReport& frame);
    /// Adds the members of an object after the rows, and gives the file its name.
    /// @throws index::Error with the first failure, also of a row
    void finish(const nlohmann::json& summary);

  private:
    void write_waiting();
    void write(const std::string& text);
    nlohmann::json row_of(const FrameReport& frame);

    std::vector<FrameReport> waiting_;
    std::array<bool, render::kFootprints> seen_{}; ///< drawn with in a row before
    index::NewFile file_;
    std::uint64_t bytes_ = 0, rows_ = 0; ///< written
    BackgroundWork writing_;             ///< last member: ends before what it writes to
};

} // namespace isochron::app
