// Options on how cells are drawn.
#include "app/explore/drawing_options.h"

#include "app/config/config_words.h"

namespace isochron::app {

void add_shape_option(Command& command, std::optional<std::string>& shape) {
    command
        .option("--shape SHAPE", shape,
                "Shape of quads and splats, instead of the configured one: plane (flat ellipses on "
                "the surface) or voxel (the spheres of the paper)")
        .one_of(words_of<render::CellShape>());
}

void set_shape(Config& config, const std::optional<std::string>& shape) {
    if (shape)
        config.rendering.cell_shape = value_of<render::CellShape>(*shape);
}

} // namespace isochron::app
