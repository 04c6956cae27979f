// Opens the tree, and keeps it in the file's cache.
#include "index/search/tree_of_file.h"

#include "index/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <vector>

namespace isochron::index {
namespace {

/// A tree, and the bytes that hold it.
struct OpenTree {
    explicit OpenTree(std::vector<std::uint64_t> read)
        : bytes(std::move(read)), tree(std::as_bytes(std::span(bytes))) {}
    std::vector<std::uint64_t> bytes;
    ThiTree tree;
};

} // namespace

std::shared_ptr<const ThiTree> tree_of(const IndexFile& file) {
    if (!file.has_tree())
        return nullptr;
    // No chunk has a key like this: theirs have small numbers.
    const ByteCache::Key key{~std::uint64_t{0}, file.header().section(SectionKind::tree).offset};
    auto open = file.kept().find<OpenTree>(key);
    if (!open) {
        std::vector<std::uint64_t> bytes = file.tree_bytes();
        const std::size_t size = bytes.size() * sizeof(std::uint64_t);
        try {
            open = std::make_shared<const OpenTree>(std::move(bytes));
            if (const std::size_t steps = file.info().steps(); open->tree.steps() != steps)
                throw Error("{} steps, the volume has {}", open->tree.steps(), steps);
        } catch (const Error& error) {
            throw file.damaged(fmt::format("tree: {}", error.what()));
        }
        file.kept().add(key, open, size);
    }
    return {open, &open->tree};
}

} // namespace isochron::index
