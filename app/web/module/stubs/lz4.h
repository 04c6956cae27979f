// LZ4 for the module: only unpacking, by a function of the page.
#pragma once
extern "C" {
__attribute__((import_module("page"), import_name("lz4"))) int
LZ4_decompress_safe(const char* packed, char* out, int packed_bytes, int out_bytes);
int LZ4_compress_default(const char*, char*, int, int); // nobody packs in the module
}
