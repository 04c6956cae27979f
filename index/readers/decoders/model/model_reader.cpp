// `isochron-reader-model`: the reader for files of triangles that no library decodes.
#include "index/readers/decoders/model/model.h"
#include "index/readers/decoders/reader_program.h"

int main() {
    return isochron::index::run_reader({}, {.model = isochron::index::decode_model});
}
