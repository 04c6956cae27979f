// Writes the examples of headers as code to be included: `extract_examples ROOT OUT FOLDER...`
// makes OUT/render/gl/gl.example of ROOT/render/gl/gl.h, and nothing where that has no example.
#include "tests/house/example_text.h"

#include <cstdio>
#include <iterator>

namespace fs = std::filesystem;

int main(int count, char** words) {
    if (count < 4)
        return std::fprintf(stderr, "usage: extract_examples ROOT OUT FOLDER...\n"), 2;
    const fs::path root = words[1], out = words[2];
    for (int i = 3; i < count; ++i)
        for (const auto& entry : fs::recursive_directory_iterator(root / words[i])) {
            if (entry.path().extension() != ".h")
                continue;
            const auto example = isochron::house::example_of(entry.path());
            if (!example)
                continue;
            const fs::path to =
                out / fs::relative(entry.path(), root).replace_extension(".example");
            // What the compiler has to say about it names the header and its line.
            const std::string text = "#line " + std::to_string(example->line) + " \"" +
                                     entry.path().string() + "\"\n" + example->text;
            std::ifstream old(to);
            if (std::string(std::istreambuf_iterator<char>(old), {}) == text)
                continue;
            fs::create_directories(to.parent_path());
            if (!(std::ofstream(to) << text).flush())
                return std::fprintf(stderr, "%s: cannot be written\n", to.c_str()), 1;
        }
}
