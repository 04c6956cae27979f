# Writes the commit that is being built, and how far it is behind the release VERSION, into the header OUT, touched only
# when it has changed.
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=*
  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/version.cmake)
file(CONFIGURE OUTPUT ${OUT} CONTENT "// The commit that was built.\n#pragma once\n\nconstexpr const char* kCommit = \"${commit}\";\n// Stands behind the release's version: empty, or `+3.gc0ffee123456`.\nconstexpr const char* kSinceRelease = \"${SINCE_RELEASE}\";\n")
