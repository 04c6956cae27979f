// The formats of pictures that are read and written.
#pragma once

namespace isochron::stereo::image_module {

enum class PictureFormat { png, exr, tiff, jpeg };

} // namespace isochron::stereo::image_module
