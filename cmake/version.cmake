# Sets SINCE_RELEASE: how far the commit of SOURCE is behind the release VERSION. Empty: it is the release, or there is no
# git. `+3.gc0ffee123456` are three commits after the tag vVERSION; `+gc0ffee123456` where there is no such tag.
execute_process(COMMAND git describe --long --abbrev=12 --match v${VERSION} WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failure)
if(failure)
  execute_process(COMMAND git rev-parse --short=12 HEAD WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failure)
endif()
set(SINCE_RELEASE "")
if(failure)
  # No git, or sources that are not in it.
elseif(described MATCHES "-([0-9]+)-(g[0-9a-f]+)$")
  if(NOT CMAKE_MATCH_1 EQUAL 0)
    set(SINCE_RELEASE "+${CMAKE_MATCH_1}.${CMAKE_MATCH_2}")
  endif()
else()
  set(SINCE_RELEASE "+g${described}")
endif()
