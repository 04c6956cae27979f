// Prints the ids of the cells through which an isosurface of the first step passes, one a line.
#include <index/file/index_file.h>
#include <index/search/index_search.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    using namespace isochron::index;
    if (argc != 3)
        return std::fprintf(stderr, "usage: list_cells NAME.isochron ISOVALUE\n"), 2;
    try {
        const auto file = IndexFile::open(argv[1]);
        const Search search = search_in(file, cheapest_method(*file));
        const CellSetPtr found = search({.instant = {}, .isovalue = std::atof(argv[2])}, {});
        for (const CellId id : found->ids)
            std::printf("%u\n", id);
    } catch (const Error& error) {
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
}
