// Reads recordings from files.
#include "app/kept/recording_file.h"

#include "index/system/input_file.h"
#include "interaction/error.h"

#include <cstdio>

namespace isochron::app {

void expect_recording(const std::filesystem::path& path) {
    std::filesystem::path part = path;
    part += ".part";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored) && std::filesystem::exists(part, ignored))
        throw interaction::Error("{}: there is no such file, but {}: a recording that was cut "
                                 "short, which can be used in its place",
                                 path.string(), part.filename().string());
    index::InputFile{path};
}

interaction::Recording read_recording(const std::filesystem::path& path) {
    expect_recording(path);
    index::InputStream file(path);
    if (const int first = file.peek(); first != EOF && first != '{')
        throw interaction::Error("{}: not a recording, which `isochron explore --record` makes",
                                 path.string());
    return interaction::read_recording(file, path.filename().string());
}

} // namespace isochron::app
