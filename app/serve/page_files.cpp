// The page, as app/web/site has it: its bytes are part of the module.
#include "app/serve/site.h"

#include <array>

// Bytes of a file between two symbols.
#define ISOCHRON_PAGE(symbol, file)                                                                \
    asm(".pushsection .rodata\n.global isochron_page_" #symbol "\nisochron_page_" #symbol          \
        ":\n.incbin \"" ISOCHRON_SITE "/" file "\"\n.global isochron_page_" #symbol                \
        "_end\nisochron_page_" #symbol "_end:\n.byte 0\n.popsection\n");                           \
    extern "C" const std::byte isochron_page_##symbol[], isochron_page_##symbol##_end[];

ISOCHRON_PAGE(html, "index.html")
ISOCHRON_PAGE(script, "assets/index.js")
ISOCHRON_PAGE(style, "assets/index.css")
ISOCHRON_PAGE(worker, "assets/worker.js")
ISOCHRON_PAGE(module, "assets/isochron.wasm")
ISOCHRON_PAGE(licenses, "licenses.txt")

namespace isochron::app {

std::span<const PageFile> page_files() {
    static const std::array<PageFile, 6> files{
        {{"index.html", {isochron_page_html, isochron_page_html_end}},
         {"assets/index.js", {isochron_page_script, isochron_page_script_end}},
         {"assets/index.css", {isochron_page_style, isochron_page_style_end}},
         {"assets/worker.js", {isochron_page_worker, isochron_page_worker_end}},
         {"assets/isochron.wasm", {isochron_page_module, isochron_page_module_end}},
         {"licenses.txt", {isochron_page_licenses, isochron_page_licenses_end}}}};
    return files;
}

} // namespace isochron::app
