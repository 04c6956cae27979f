// Opens the index, the arrays and the steps that a user names. An error says in one line what is
// not there.
#pragma once

#include "index/file/index_file.h"
#include "index/volume/instant.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace isochron::index {

/// @throws Error as IndexFile::open; if the file exists but is no .isochron, the message says how to
///         build an index of it
/// @param arrays that the user names, which that index is to have
std::shared_ptr<const IndexFile> open_named_index(const std::filesystem::path& path,
                                                  std::uint64_t cache_bytes = 0,
                                                  const std::vector<std::string>& arrays = {});

/// The names of its arrays.
std::vector<std::string> array_names(const IndexFile& file);
/// The number of an array. @throws Error naming the arrays when there is no such array
std::size_t array_number(const IndexFile& file, const std::string& name);

/// @throws Error when there is no such step
std::uint32_t step_named(const IndexFile& file, std::int64_t step);
/// The moment at `fraction` / Instant::kFractions of the way from a step to the next one.
/// @throws Error naming the file when there is none, or no step follows
Instant instant_named(const IndexFile& file, std::int64_t step, std::int64_t fraction);

/// @throws Error when the cells of two queries cannot be compared, as their numbers take 64 bits
void expect_narrow_ids(const IndexFile& file);

} // namespace isochron::index
