// What is drawn, as one value: a scene draws equal pictures to the bit alike.
#pragma once

#include "app/scene/audience.h"
#include "app/scene/color_scale.h"
#include "app/scene/guides.h"
#include "index/extraction/extraction.h"
#include "index/extraction/instant_surfaces.h"
#include "index/extraction/slice_values.h"
#include "index/volume/triangle_mesh.h"
#include "index/volume/volume_series.h"
#include "interaction/commands.h"
#include "interaction/pointed.h"
#include "interaction/tools/tool.h"
#include "render/cells/footprints.h"
#include "render/drawing/triangle_pass.h"
#include "render/passes/veil_pass.h"
#include "stereo/installation.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// Things that show where somebody points.
struct Aids {
    std::optional<interaction::Pose> wand;
    std::optional<interaction::Pointed> pointed;
    bool operator==(const Aids&) const = default;
};

/// Where the eyes' pictures lie in the windows.
struct PictureLayout {
    std::vector<glm::ivec2> windows; ///< their sizes [pixel]
    stereo::Margins free;            ///< for the panel over the first one
    float aside = 0;                 ///< share of width, see Outputs::show_aside
    float text = 0;                  ///< share of height that words have, see `text_height`
    /// What lies over the upper corners, left and right: from the corner on, in heights of the words.
    std::array<glm::vec2, 2> corners{};
    bool operator==(const PictureLayout&) const = default;
};

/// Whether the panel over the first window comes or goes, and nothing else is new.
inline bool only_panel_differs(const PictureLayout& a, const PictureLayout& b) {
    return a != b && a.windows == b.windows && a.aside == b.aside;
}

/// Array whose surfaces are shown, as words about its values need it.
struct ShownValues {
    std::string array, unit;
    index::ValueType type{};
    int digits = index::kFewestDigits; ///< significant ones in which its values are said
    bool operator==(const ShownValues&) const = default;
};

/// A slice, and how its values are shown.
struct ShownSlice {
    index::SliceValuesPtr values;
    ColorScale scale;
    std::vector<interaction::Isosurface> lines; ///< drawn where its values are theirs
    bool operator==(const ShownSlice&) const = default;
};

/// Triangles that stand beside the surfaces: of a model.
struct ShownTriangles {
    index::TriangleMeshPtr mesh;
    render::TriangleLook look;
    bool operator==(const ShownTriangles&) const = default;
};

/// Surfaces of another instant, and how they are shown.
struct ShownGhost {
    index::InstantSurfacesPtr surfaces;
    std::vector<glm::vec3> colors; ///< by surface, sRGB
    float opacity = 0;
    bool earlier = false; ///< than the surfaces; else later
    bool operator==(const ShownGhost&) const = default;
};

/// A surface of another array than the shown one, and how it is shown.
struct ShownFurther {
    index::InstantSurfacesPtr surfaces; ///< with this one alone, in its place
    interaction::Isosurface look;       ///< with the isovalue that it has
    ShownValues values;
    bool simplified = false; ///< also at rest
    bool operator==(const ShownFurther&) const = default;

    const index::CellMeshPtr& mesh() const { return surfaces->meshes.back(); } ///< null: no cells
};

/// The place that a step of a story is about, and what stands beside it.
struct ToldPlace {
    glm::dvec3 place{0.0}; ///< physical space
    std::vector<std::string> lines;
    bool operator==(const ToldPlace&) const = default;
};

/// Words over a film.
struct Title {
    std::string words; ///< wrapped to two lines at most; empty: there is none
    float opacity = 0; ///< 0 to 1
    bool operator==(const Title&) const = default;
};

/// Everything that the eyes' pictures depend on.
struct Picture {
    Audience audience;
    interaction::Mark mark;
    std::vector<interaction::NamedMark> marks;
    std::optional<interaction::Pointed> pointed;
    std::optional<ToldPlace> told;
    interaction::ToolDrawing tools;
    std::vector<interaction::ClipPlane> cuts; ///< away what is beyond any of them
    Guides guides;
    render::Veil veil;
    interaction::Similarity room_from_physical;
    render::Footprint footprint{};
    std::size_t resolution = 0; ///< number of the cells' resolution: see `kCellResolutions`
    index::ExtractionPtr cells;
    std::vector<interaction::Isosurface> isosurfaces;
    ShownValues values;                 ///< whose surfaces they are
    bool surfaces = true;               ///< surfaces are drawn
    std::vector<ShownSlice> slices;     ///< beside them
    std::vector<ShownTriangles> beside; ///< beside them, too
    std::vector<ShownGhost> ghosts;     ///< beside them, by time
    std::vector<ShownFurther> further;  ///< beside them: those of `isosurfaces` of other arrays
    interaction::Look look;
    bool transparent = false;        ///< nothing is drawn behind the data, whatever `look` says
    std::optional<ColorScale> scale; ///< empty: colors tell surfaces apart
    bool bounding_box = true;
    bool legend = true;
    bool orientation = false; ///< the data's axes and a scale bar in a corner
    std::string caption;      ///< in a corner; empty: none
    Title title;
    /// Mesh level of the footprint `mesh` (index/extraction/simplified_meshes.h).
    std::size_t mesh_level = 0;
    /// The exact picture that is kept is moved to where its cells are seen now, in the place of
    /// what the footprint says.
    bool moved = false;
    PictureLayout layout;
    bool operator==(const Picture&) const = default;
};

} // namespace isochron::app
