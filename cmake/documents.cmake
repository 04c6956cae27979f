# Writes copyright, changelog and the notices of libraries that are compiled in, for all PACKAGES, below OUT.
file(REMOVE_RECURSE ${OUT})
file(READ ${SOURCE}/LICENSE license)
string(REGEX MATCH "Copyright [^\n]*" holder "${license}")
string(REGEX REPLACE "^Copyright (\\(c\\) )?" "" holder "${holder}")
string(REGEX REPLACE "^[^\n]*\n\n[^\n]*\n\n" "" license "${license}") # title and holder stand in fields of their own
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n" "\n " license "${license}")
string(STRIP "${license}" license)
set(copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Isochron
Comment: notices of libraries that are compiled in are in the folder third-party

Files: *
Copyright: ${holder}
License: BSD-3-Clause
 ${license}
")
file(STRINGS ${SOURCE}/CHANGELOG.md dated REGEX "^## ${VERSION} ")
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+" day "${dated}")
if(NOT day)
  # Not released: the day of the commit.
  execute_process(COMMAND git log -1 --format=%cs WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE day
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT day)
  set(day 1970-01-01)
endif()
execute_process(COMMAND date -u -R -d ${day} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)
include(${CMAKE_CURRENT_LIST_DIR}/version.cmake)
set(of_all "${copyright}")
foreach(package IN LISTS PACKAGES)
  set(copyright "${of_all}")
  if(package STREQUAL isochron-generate)
    # Its sources are under the license of all; what is linked with FFTW is under FFTW's.
    string(APPEND copyright "
Files: usr/libexec/isochron/isochron-generate
Copyright: ${holder}
           2003, 2007-2014 Matteo Frigo, Massachusetts Institute of Technology
License: GPL-2+
 The program is linked with FFTW, https://www.fftw.org, which is free software
 under the GNU General Public License, version 2 or (at your option) any later
 version. The program as a whole is under the same terms; on Debian they are in
 /usr/share/common-licenses/GPL-2.
")
  endif()
  set(libraries libcli11-dev nlohmann-json3-dev libtomlplusplus-dev libglm-dev libimgui-dev libhwy-dev libstb-dev)
  if(package MATCHES "^isochron-")
    set(libraries nlohmann-json3-dev libglm-dev libhwy-dev)
    if(package STREQUAL isochron-generate)
      list(APPEND libraries libcli11-dev)
    endif()
  elseif(package STREQUAL python3-isochron)
    set(libraries nlohmann-json3-dev libglm-dev libhwy-dev pybind11-dev)
  endif()
  set(changelog "${package} (${VERSION}${SINCE_RELEASE}) stable; urgency=medium\n\n  * See CHANGELOG.md.\n\n -- ${MAINTAINER}  ${date}\n")
  file(WRITE ${OUT}/${package}/copyright "${copyright}")
  file(WRITE ${OUT}/${package}/changelog "${changelog}")
  execute_process(COMMAND gzip -9n ${OUT}/${package}/changelog)
  foreach(library IN LISTS libraries)
    if(EXISTS /usr/share/doc/${library}/copyright)
      configure_file(/usr/share/doc/${library}/copyright ${OUT}/${package}/third-party/${library} COPYONLY)
    endif()
  endforeach()
endforeach()
