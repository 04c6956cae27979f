// Zstandard for the module: only unpacking, by a function of the page.
#pragma once
#include <cstddef>
struct ZSTD_DCtx;
struct ZSTD_CCtx;
extern "C" {
__attribute__((import_module("page"), import_name("zstd"))) std::size_t
isochron_zstd(void* out, std::size_t out_bytes, const void* packed, std::size_t packed_bytes);
// Nobody packs in the module.
std::size_t ZSTD_compressCCtx(ZSTD_CCtx*, void*, std::size_t, const void*, std::size_t, int);
ZSTD_CCtx* ZSTD_createCCtx();
std::size_t ZSTD_freeCCtx(ZSTD_CCtx*);
unsigned ZSTD_isError(std::size_t);
}
inline ZSTD_DCtx* ZSTD_createDCtx() { return nullptr; }
inline std::size_t ZSTD_freeDCtx(ZSTD_DCtx*) { return 0; }
inline std::size_t ZSTD_decompressDCtx(ZSTD_DCtx*, void* out, std::size_t out_bytes,
                                       const void* packed, std::size_t packed_bytes) {
    return isochron_zstd(out, out_bytes, packed, packed_bytes);
}
