// Reads recordings from files.
#include "app/kept/recording_file.h"

#include "index/system/input_file.h"
#include "interaction/error.h"

#include <cstdio>

namespace isochron::app {

interaction::Recording read_recording(const std::filesystem::path& path) {
    index::InputStream file(path);
    if (const int first = file.peek(); first != EOF && first != '{')
        throw interaction::Error("{}: not a recording, which `isochron explore --record` makes",
                                 path.string());
    return interaction::read_recording(file, path.filename().string());
}

} // namespace isochron::app
