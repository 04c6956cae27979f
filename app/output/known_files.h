// Recognizes the files that this program writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace isochron::app {

/// What a file is to hold. An existing file of the same kind may be replaced, as far as it can be
/// recognized: recordings, movies, surfaces and configurations that a user may have changed
/// are only replaced with --force.
enum class OutputKind : std::uint8_t {
    index,
    ids,
    picture,
    report,
    session,
    manual_page,
    configuration,
    recording,
    surface, ///< a mesh or a table for other programs
    movie    ///< in one file, or as frames in a folder
};

struct Output {
    std::filesystem::path path;
    OutputKind kind;
    std::uint64_t cells = 0;  ///< for ids: the number of cells that there are
    std::string content = {}; ///< for a configuration: what is to be written
};

/// Whether this program wrote a regular file, as an output of this kind. An empty file counts as
/// written by the program, except where recordings and movies are expected. Reads only as much of
/// the file as the answer takes.
bool is_known(const std::filesystem::path& file, const Output& output);

/// Whether the first MiB of a file names a format, in quotation marks, as recordings and sessions do.
bool names_format(const std::filesystem::path& file, const std::string& format);

/// What a file is, for people: `an index`, `a folder`, `a file of 1234 bytes`.
std::string words_for(const std::filesystem::path& file);

} // namespace isochron::app
