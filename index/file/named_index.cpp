// Opens the index that a user names, and finds in it what is named.
#include "index/file/named_index.h"

#include "index/shell_word.h"
#include "index/system/links/link.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace isochron::index {

std::shared_ptr<const IndexFile> open_named_index(const std::filesystem::path& path,
                                                  std::uint64_t cache_bytes,
                                                  const std::vector<std::string>& arrays) {
    try {
        return IndexFile::open(path, cache_bytes);
    } catch (const Error& error) {
        if (is_link(path.native()) && path.extension() != ".isochron" && path.has_filename())
            throw Error("{}; links lead to indices alone: download other files", error.what());
        std::error_code ignored;
        if (path.extension() == ".isochron" || !std::filesystem::is_regular_file(path, ignored))
            throw;
        std::filesystem::path made = path;
        made.replace_extension(".isochron");
        std::string options;
        for (const std::string& array : arrays)
            options += " --array " + shell_word(array);
        throw Error("{}; `isochron build {} -o {}{}` makes an index of data", error.what(),
                    shell_word(path.string()), shell_word(made.string()), options);
    }
}

std::vector<std::string> array_names(const IndexFile& file) {
    std::vector<std::string> names;
    for (std::size_t number = 0; number < file.arrays(); ++number)
        names.push_back(file.array(number).info().array);
    return names;
}

std::size_t array_number(const IndexFile& file, const std::string& name) {
    const auto number = file.array_called(name);
    if (!number)
        throw Error("{}: no array {}, expected {}", file.name(), name,
                    fmt::join(array_names(file), ", "));
    return *number;
}

std::uint32_t step_named(const IndexFile& file, std::int64_t step) {
    const auto steps = static_cast<std::int64_t>(file.info().steps());
    if (step < 0 || step >= steps)
        throw Error("{}: step {}, expected 0 to {}", file.name(), step, steps - 1);
    return static_cast<std::uint32_t>(step);
}

Instant instant_named(const IndexFile& file, std::int64_t step, std::int64_t fraction) {
    const std::uint32_t named = step_named(file, step);
    if (fraction < 0 || fraction >= Instant::kFractions)
        throw Error("{}: fraction {}, expected 0 to {}", file.name(), fraction,
                    Instant::kFractions - 1);
    if (fraction > 0 && named + std::size_t{1} >= file.info().steps())
        throw Error("{}: fraction {} after step {}, which is the last one: expected 0", file.name(),
                    fraction, step);
    return {named, static_cast<std::uint32_t>(fraction)};
}

void expect_narrow_ids(const IndexFile& file) {
    if (const Grid& grid = file.info().grid; has_wide_ids(grid))
        throw Error("{}: {} cells, expected fewer than 2^32 to compare", file.name(),
                    grid.cell_count());
}

} // namespace isochron::index
