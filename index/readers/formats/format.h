// The record of a file format. Everything that depends on a file's format is asked of this record.
//
//     const KnownFile file = known_file("run/t_0030.vti");
//     if (file.format)
//         std::unique_ptr<VolumeFile> volume = open_in_format(*file.format, file.path, options);
#pragma once

#include "index/readers/formats/volume_file.h"
#include "index/volume/listed_file.h"

#include <string>
#include <string_view>
#include <utility>

namespace isochron::index {

struct SeriesFile;

/// The first bytes of a file, read as far as formats look at them.
class FileStart {
  public:
    explicit FileStart(std::filesystem::path path) : path_(std::move(path)) {}

    const std::filesystem::path& path() const { return path_; }
    /// The first bytes, as many as asked for, or all. None if this is no file, or cannot be read.
    std::string_view bytes(std::size_t count);

  private:
    std::filesystem::path path_;
    std::string bytes_;
    std::size_t asked_ = 0; ///< for bytes of the file so far
};

/// An end of the names of a format's files.
struct NameEnd {
    std::string_view end; ///< in lower case: `.nii.gz`
    /// Ends of the names of files that such a file names: in a folder, they belong to it.
    std::vector<std::string_view> named = {};
    /// Decides whether a file with this end is of the format; null: the end suffices.
    bool (*only_if)(FileStart& start) = nullptr;
    /// Whether the folder of such a file is read with it.
    bool with_folder = false;
};

struct Format {
    /// By which its reader knows it, too.
    std::string_view name;
    std::vector<NameEnd> ends;
    /// Whether the first bytes tell that a file is of this format, whatever its name; null: they
    /// never do.
    bool (*recognize)(FileStart& start) = nullptr;
    /// Whether a file with one of the ends may begin as another format does; null: `recognize`.
    bool (*may_begin)(FileStart& start) = nullptr;

    /// How one file is opened; null: by a reader.
    std::unique_ptr<VolumeFile> (*open)(const std::filesystem::path& path,
                                        const ReadOptions& options) = nullptr;
    /// `netcdf` of isochron-reader-netcdf, which opens its files; empty: none does.
    std::string_view reader = {};
    /// Whether its reader reads no more than the part that `crop` names, where it can.
    bool reads_parts = false;
    /// Whether the reader's library decodes all arrays of a file together.
    bool decodes_all_arrays = false;

    /// How several files are put together, where their numbers or contents say which part each file
    /// holds; null: each file has steps of its own. @throws Error naming a file that does not fit
    std::vector<SeriesFile> (*join)(const Format& format,
                                    const std::vector<std::filesystem::path>& files,
                                    const ReadOptions& options) = nullptr;
    /// Whether their names say it.
    bool joins_by_names = false;
    /// What a file names that is a list of files; null: it holds values. @throws Error naming it
    ListedFiles (*list)(const std::filesystem::path& path) = nullptr;
    /// Whether files of the same time in a list are parts of one volume.
    bool lists_parts = false;

    /// Whether a file may name others whose values are read with it, in words that stand in it.
    bool names_files = false;
    /// Whether its files are values alone, which only options describe.
    bool headerless = false;
    /// Files that describe a folder, by their paths within it: the folder is one volume.
    std::vector<std::string_view> describe_folder = {};
    /// Ends of the names of such folders.
    std::vector<std::string_view> folder_ends = {};
};

/// Every format that the program reads.
const std::vector<Format>& all_formats();

/// @param name that is one of them
const Format& format_named(std::string_view name);

/// The folder that is read with a file which describes it; empty: none is.
std::filesystem::path described_folder(const std::filesystem::path& file);

/// What a name stands for.
struct KnownFile {
    std::filesystem::path given;
    std::filesystem::path path;     ///< for a folder that a file in it describes: this file
    const Format* format = nullptr; ///< null: unknown, or it cannot be read
    const NameEnd* end = nullptr;   ///< ending of its name; null: its content told
    bool is_folder = false;         ///< what is given
};

/// Asks the formats for a file, by the end of its name in upper or lower case, and by its first
/// bytes: they count where they tell another format than the name.
KnownFile known_file(const std::filesystem::path& given);
KnownFile known_file(const std::filesystem::path& given, bool is_folder);

/// Whether the first bytes are such that a file with one of the format's ends is of it.
bool begins_as(const Format& format, FileStart& start);

/// The format that the first bytes of a file tell; null: none.
const Format* told_by_content(FileStart& start);

/// Whether a file is of a format, as known or told; dual files of TIFF and DICOM are of both.
bool is_of_format(const Format& format, const KnownFile& file);

/// Whether a file, or a folder that is one volume, can be read as far as its name tells.
bool has_known_end(const std::string& name, bool folder);

/// The file name extensions of all formats, as in ".pvd .vti .vtk".
std::string known_extensions();

} // namespace isochron::index
