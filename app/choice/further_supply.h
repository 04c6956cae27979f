// The surfaces of other arrays than the shown one, made beside the frames as triangles.
#pragma once

#include "app/choice/frame.h"
#include "app/choice/surfaces_asker.h"
#include "app/scene/picture.h"
#include "index/extraction/instant_surfaces.h"
#include "index/file/index_file.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// Number of the surface that a query of one is for: its isovalue is the last.
inline std::size_t surface_of(const index::SurfacesQuery& query) {
    return query.isovalues.size() - 1;
}

/// One surface is made at a time. While the picture moves it may be simplified, and until it is there
/// the last one is shown, as what it is; at rest, and in a replay, it has all triangles of `mesh_of`.
class FurtherSupply {
  public:
    /// Triangles of one surface: at rest, and while the picture moves, where a processor sorts them.
    static constexpr std::uint64_t kMost = 1 << 22, kMostMoving = 1 << 18;

    explicit FurtherSupply(std::shared_ptr<const index::IndexFile> file);

    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }
    /// Sets the function that is called, on the making thread, when a surface has been made.
    void set_wake(std::function<void()> wake) { making_.set_wake(std::move(wake)); }

    /// Called once a frame. Never waits in a live session; a replay waits for what it asks for.
    /// @param wished one surface each, see `surface_of`
    void update(const Frame& frame, const std::vector<index::SurfacesQuery>& wished);
    /// In the order of the last wishes; those that have never been there are left out.
    const std::vector<index::InstantSurfacesPtr>& shown() const { return shown_; }
    /// Whether surfaces are still to be made, or to be made better.
    bool come() const { return come_; }
    /// Why surfaces could not be made; taken by the call.
    std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

  private:
    void take();
    index::InstantSurfacesPtr best(const index::SurfacesQuery& query, std::uint64_t most) const;
    std::optional<WantedSurfaces> next(std::span<const index::SurfacesQuery> wished,
                                       std::uint64_t most) const;
    void drop_unwished(std::span<const index::SurfacesQuery> wished);

    std::shared_ptr<const index::IndexFile> file_;
    std::vector<index::InstantSurfacesPtr> kept_,
        shown_; ///< `kept_`: the last one made is the last
    std::vector<index::SurfacesQuery> failed_;
    std::optional<WantedSurfaces> makes_;              ///< what is being made
    std::shared_ptr<index::KnownCrossings> crossings_; ///< null: none are wished
    bool come_ = false;
    std::vector<std::string> messages_;
    SurfacesAsker making_;
};

/// Whether a further surface has the colors that the state asks for.
bool colored_as_asked(const index::InstantSurfaces& made, const ExplorerState& state,
                      const index::IndexFile& file);

/// The further surfaces of a picture. @param file all its arrays
std::vector<ShownFurther> shown_further(const std::vector<index::InstantSurfacesPtr>& made,
                                        const ExplorerState& state, const index::IndexFile& file);

} // namespace isochron::app
