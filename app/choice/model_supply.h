// The files of triangles that a session shows, read beside the frames.
#pragma once

#include "app/choice/frame.h"
#include "app/frame/asker.h"
#include "app/panel/panel_model.h"
#include "index/volume/triangle_mesh.h"

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// A file is opened if it lies in the folder of the data, of the session or of the recording, or below, or
/// if its user has named it: recordings and sessions come from elsewhere, too, and must not open other
/// files. A relative path is looked for in these folders. A series of files (index::is_model_series) has
/// one for each step: that of the last step stays until the next one is read.
class ModelSupply {
  public:
    /// @param data the index, in whose folder models may lie
    explicit ModelSupply(const std::filesystem::path& data);

    /// Lets models lie in this folder, too.
    void add_folder(const std::filesystem::path& folder);
    /// Lets this model be opened, wherever it lies. @return its path as a setting has it: relative if it
    /// lies in the first of the folders that holds it, else absolute
    std::string allow(const std::filesystem::path& file);
    /// Lets the models be opened that these commands name, which the user gives.
    void allow_those_of(const interaction::Commands& commands);
    /// Lets all models be opened that settings name: those of another process of the same user.
    void allow_all() { all_ = true; }
    /// The files that are shown because they were allowed.
    std::vector<std::string> allowed(const ExplorerState& state) const;

    /// Sets the function that is called, on the reading thread, when a model has been read.
    void set_wake(std::function<void()> wake) { reading_.set_wake(std::move(wake)); }
    /// Called once a frame. Never waits in a live session; a replay waits for what it asks for.
    void update(const Frame& frame);
    /// The triangles of a picture.
    std::vector<ShownTriangles> shown(const ExplorerState& state) const;
    /// Whether models are still being read.
    bool come() const { return reads_ > 0; }
    /// What the panel shows of each model.
    std::vector<ListedModel> listed(const ExplorerState& state) const;
    /// Where data and models lie, in their order the lowest and the highest coordinates; without those models that
    /// would make the picture more than kMostSpan times as wide as the data.
    std::array<glm::dvec3, 2> box(const ExplorerState& state, const index::Grid& grid) const;
    static constexpr double kMostSpan = 20;

    /// What is wrong with models; taken by the call.
    std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }
    /// All that was wrong so far.
    const std::vector<std::string>& faults() const { return faults_; }

  private:
    struct Known {
        index::TriangleMeshPtr mesh; ///< null: not there yet
        std::array<glm::dvec3, 2> box{};
        std::string fault;
        bool refused = false, asked = false, reading = false;
        std::optional<std::uint32_t>
            step{}; ///< step whose file was asked for; none: it is one file for all
    };
    struct Read {
        std::string path;
        index::TriangleMeshPtr mesh;
        std::string failure; ///< empty: none
    };
    struct Wanted {
        std::string path; ///< as the setting has it
        std::filesystem::path file;
        std::string unit; ///< unit of length of the data
        std::optional<std::uint32_t> step{};
        std::size_t steps = 0; ///< steps of the data
    };
    static Read read(const Wanted& wanted, const Asking& asking);
    std::filesystem::path place_of(const std::string& path) const;
    bool may_open(const std::filesystem::path& file) const;
    static bool wants_file(Known& known, const std::string& path, std::uint32_t step);
    void ask(const std::string& path, Known& known, const Frame& frame);
    void take(const index::SeriesInfo& info);
    void complain(Known& known, const std::string& fault);

    std::vector<std::filesystem::path> folders_; ///< absolute
    std::set<std::filesystem::path> allowed_;    ///< without links
    bool all_ = false;
    std::map<std::string, Known> known_; ///< by path, as the settings have it
    int reads_ = 0;
    std::vector<std::string> messages_, faults_;
    Asker<Wanted, Read> reading_;
};

} // namespace isochron::app
