// Recordings in files.
#include "app/session/recording_file.h"

#include "index/system/input_file.h"

namespace isochron::app {

interaction::Recording read_recording(const std::filesystem::path& path) {
    index::InputStream file(path);
    return interaction::read_recording(file, path.filename().string());
}

} // namespace isochron::app
