#!/bin/sh
# Builds the module of the page: build.sh OUT.wasm, with Debian's clang-19, lld-19, libc++-19-dev-wasm32,
# libclang-rt-19-dev-wasm32 and wasi-libc.
set -eu
out=$(realpath "$1")
cd "$(dirname "$0")/../../.."
here=app/web/module
flags="--target=wasm32-wasi --sysroot=/usr -stdlib=libc++ -isystem $here/stubs
  -isystem /usr/lib/llvm-19/include/wasm32-wasi/c++/v1 -idirafter /usr/include -I. -std=c++20 -O3 -msimd128
  -fno-exceptions -fno-rtti -ffunction-sections -fdata-sections -Wno-c++11-narrowing -DNDEBUG
  -DGLM_FORCE_XYZW_ONLY -D_LIBCPP_AVAILABILITY_HAS_INIT_PRIMARY_EXCEPTION=0"
objects=$(mktemp -d)
trap 'rm -rf "$objects"' EXIT
for source in $here/module.cpp index/extraction/slice_runs.cpp index/scan/scan.cpp index/surface/mesh_maker.cpp index/surface/mesh_vertices.cpp \
  index/surface/mesh_cases.cpp index/surface/cell_mesh.cpp index/surface/cell_colors.cpp index/file/chunks/packed_rows.cpp \
  index/file/chunks/chunk_sums.cpp index/file/chunks/chunk_codec.cpp index/file/chunks/chunk_grid.cpp \
  index/file/chunks/chunk_differences.cpp index/file/sections/step_levels.cpp index/file/blended_ranks.cpp \
  index/volume/blend.cpp index/volume/stored_cut.cpp \
  index/volume/grid.cpp index/volume/level_map.cpp index/volume/value_type.cpp; do
  # Highway of Debian 12 has no vectors of f64 for WebAssembly, which these need.
  case $source in index/scan/scan.cpp | index/volume/blend.cpp | index/file/chunks/chunk_differences.cpp) how=-DHWY_COMPILE_ONLY_SCALAR ;; *) how=-DHWY_COMPILE_ONLY_STATIC ;; esac
  # shellcheck disable=SC2086
  clang++-19 $flags $how -c "$source" -o "$objects/$(basename "$source" .cpp).o"
done
clang++-19 --target=wasm32-wasi --sysroot=/usr -mexec-model=reactor -fuse-ld=lld -nostdlib++ -Wl,--gc-sections,--strip-all,-z,stack-size=262144 \
  "$objects"/*.o -L/usr/lib/llvm-19/lib/wasm32-wasi -lc++ -lc++abi -o "$out"
