// Options on how cells are drawn.
#include "app/explore/drawing_options.h"

namespace isochron::app {

void add_shape_option(Command& command, std::optional<std::string>& shape) {
    command
        .option("--shape", shape,
                "Shape of quads and splats, instead of the configured one: plane (flat ellipses on "
                "the surface) or voxel (the paper's spheres)")
        .one_of(cell_shape_names());
}

void set_shape(Config& config, const std::optional<std::string>& shape) {
    if (shape)
        config.rendering.cell_shape = cell_shape_from_name(*shape);
}

} // namespace isochron::app
