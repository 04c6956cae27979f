// Which array of the index a session shows, by which it colors, and how others were left.
#pragma once

#include "app/config/config.h"
#include "app/frame/explorer_state.h"
#include "app/panel/panel_model.h"
#include "index/file/index_file.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::app {

/// Whether an array has finite values at any step; else its range is 0 to 0.
bool has_values(const index::IndexStats& stats);
/// Whether an array has different values, and so surfaces.
inline bool has_surfaces(const index::IndexStats& stats) {
    return stats.low < stats.high;
}
/// The next array of the file, after this one and around, that has surfaces; empty: no other has.
std::optional<std::size_t> next_with_surfaces(const index::IndexFile& file, std::size_t number);

class ShownArrays {
  public:
    /// Reads the step that is shown first.
    /// @param home the start state
    ShownArrays(const Config& config, std::shared_ptr<const index::IndexFile> file,
                const ExplorerState& home);

    const std::shared_ptr<const index::IndexFile>& file() const { return file_; }
    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }
    std::span<const std::string> names() const { return names_; }
    const std::vector<std::string>& color_names() const { return color_names_; }
    /// What a panel shows of them. @param state lives as long as what is returned
    PanelArrays in_panel(const ExplorerState& state) const;

    /// The array whose surfaces are asked for, as `index::IndexFile::array` takes it.
    std::size_t number(const ExplorerState& state) const {
        return file_->array_called(state.array).value_or(0);
    }
    const index::IndexFile& shown(const ExplorerState& state) const {
        return file_->array(number(state));
    }
    /// This array, sharing the ownership of the file.
    std::shared_ptr<const index::IndexFile> held(const ExplorerState& state) const;
    /// What is asked for: the state's surfaces of the shown array.
    index::SurfacesQuery surfaces(const ExplorerState& state) const;
    /// The state's surfaces of other arrays that are seen: one each, see `surface_of`.
    std::vector<index::SurfacesQuery> further(const ExplorerState& state) const;
    /// The number of a surface's array. @param surface number of the surface
    std::size_t number(const ExplorerState& state, std::size_t surface) const {
        return array_of_surface(state, surface, *file_);
    }
    const index::IndexFile& of(const ExplorerState& state, std::size_t surface) const {
        return file_->array(number(state, surface));
    }
    std::shared_ptr<const index::IndexFile> held(const ExplorerState& state,
                                                 std::size_t surface) const {
        return array_of(file_, number(state, surface));
    }
    /// The array with this name; the shown one if the name is empty or unknown.
    std::shared_ptr<const index::IndexFile> called(const std::string& name,
                                                   const ExplorerState& state) const {
        const auto named = name.empty() ? std::nullopt : file_->array_called(name);
        return named ? array_of(file_, *named) : held(state);
    }
    /// Gives the surfaces of the shown array no array of their own.
    /// @return what the user should know of arrays that the data lack
    std::vector<std::string> settle(ExplorerState& state) const;

    /// @param name of an array of the surfaces; empty: the first
    /// @throws index::Error when the index has no such array
    void expect(const std::string& name) const;
    /// Remembers how the array before was left. @return whether there is another now
    /// @throws index::Error when the index lacks the array of the surfaces
    bool turn(const ExplorerState& before, const ExplorerState& now);
    /// How arrays that are not shown were left; `recall` sets it again.
    std::vector<interaction::Commands> left(const ExplorerState& state) const;
    void recall(const std::vector<interaction::Commands>& left);
    /// Commands that show an array as it was left, or as at a first look.
    interaction::Commands way_to(std::size_t number, const ExplorerState& state) const;

  private:
    std::shared_ptr<const index::IndexFile> file_;
    std::vector<std::string> names_, color_names_;
    std::vector<std::string> notes_; ///< range and unit of each array: `0.02 to 40.3 1/s`
    std::vector<ListedArray> lines_;
    /// The surfaces at the first look at each array.
    std::vector<std::vector<interaction::Isosurface>> first_surfaces_;
    /// How arrays that were shown before were left, by number.
    std::map<std::size_t, interaction::Commands> left_;
};

} // namespace isochron::app
