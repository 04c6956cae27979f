# Checks the shaders in FOLDER: cmake -DVALIDATOR=... -DFOLDER=... -P check.cmake.
file(GLOB files "${FOLDER}/*")
execute_process(COMMAND "${VALIDATOR}" ${files}
  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  # Every file is named, and every message comes once for each variant.
  string(REGEX MATCHALL "[^\n]*render/shaders/[^\n]*" complaints "${output}")
  list(REMOVE_DUPLICATES complaints)
  list(JOIN complaints "\n" complaints)
  if(NOT complaints)
    set(complaints "${output}")
  endif()
  message("${complaints}")
  message(FATAL_ERROR "glslangValidator refuses shaders, status ${status}")
endif()
