# Writes OUT, a C++ source with the text of every file in SHADERS: cmake -DOUT=... -DSHADERS=a,b -P.
string(REPLACE "," ";" SHADERS "${SHADERS}")
set(table "")
foreach(path IN LISTS SHADERS)
  get_filename_component(name "${path}" NAME)
  file(RELATIVE_PATH below "${CMAKE_CURRENT_LIST_DIR}/shaders" "${path}")
  file(READ "${path}" text)
  string(APPEND table "    {\"${name}\", R\"glsl(${text})glsl\", \"${below}\"},\n")
endforeach()
file(WRITE "${OUT}.new" "// Written by embed_shaders.cmake from render/shaders.
#include \"render/gl/shader.h\"

namespace isochron::render {

const std::vector<ShaderSource>& shader_files() {
    static const std::vector<ShaderSource> files{
${table}    };
    return files;
}

} // namespace isochron::render
")
file(RENAME "${OUT}.new" "${OUT}")
