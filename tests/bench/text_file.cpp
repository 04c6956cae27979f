// Writes text files, which appear under their name only when complete.
#include "tests/bench/text_file.h"

#include "index/system/new_file.h"

#include <span>

namespace isochron::bench {

void write_text(const std::filesystem::path& path, const std::string& text) {
    index::NewFile file(path);
    file.write_at(0, std::as_bytes(std::span(text)));
    file.commit();
}

} // namespace isochron::bench
