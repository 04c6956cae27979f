# Debian packages by `cpack`: the program, its components, the library `index` for developers, and the Python module.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME isochron)
set(CPACK_PACKAGE_VENDOR "${PROJECT_AUTHORS}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "immersive explorer of time-varying volume data")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library ${ISOCHRON_COMPONENTS})
if(TARGET isochron_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Debian asks for an address; where there is none, this one is none either (RFC 2606).
set(contact "${PROJECT_CONTACT}")
if(NOT contact)
  set(contact "nobody@unpublished.invalid")
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${PROJECT_AUTHORS} <${contact}>")
if(PROJECT_HOMEPAGE)
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${PROJECT_HOMEPAGE}")
endif()
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME isochron)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, libegl1, libgl1, libgl1-mesa-dri")
# Loaded when they are needed, and named by the program where they are missing.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "isochron-generate, libosmesa6, ${ISOCHRON_PICTURE_PACKAGE}")
file(WRITE ${CMAKE_BINARY_DIR}/dependencies_of_program
  "#!/bin/sh\n# What the programs and modules are linked with, without that.\nexec dpkg-shlibdeps -x${ISOCHRON_PICTURE_PACKAGE} \"$@\"\n")
file(CHMOD ${CMAKE_BINARY_DIR}/dependencies_of_program
  PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# Read when packages are made: what is between releases has a version of its own.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/package_settings.cmake @ONLY CONTENT [[
set(SHLIBDEPS_EXECUTABLE "@CMAKE_BINARY_DIR@/dependencies_of_program")
set(SOURCE "@CMAKE_SOURCE_DIR@")
set(VERSION "@PROJECT_VERSION@")
include("@CMAKE_SOURCE_DIR@/cmake/version.cmake")
string(APPEND VERSION "${SINCE_RELEASE}")
set(CPACK_PACKAGE_VERSION "${VERSION}")
set(CPACK_DEBIAN_PACKAGE_VERSION "${VERSION}")
foreach(component IN ITEMS VTK MPI GENERATE PYTHON)
  string(REPLACE "VERSION_OF_ALL" "${VERSION}" CPACK_DEBIAN_${component}_PACKAGE_DEPENDS "${CPACK_DEBIAN_${component}_PACKAGE_DEPENDS}")
endforeach()
]])
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_BINARY_DIR}/package_settings.cmake)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, isochron-readers-vtk, isochron-mpi")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Isochron lets scientists stand inside a series of volumes, such as a
simulation, a scan or a film of a microscope, and drag isovalue and time of
its isosurfaces at display rate: on a desktop, in a CAVE, or in a headset.")

# isochron_component_package(COMPONENT package text): one that the program loads or starts, of its own version.
function(isochron_component_package component package text)
  foreach(setting IN ITEMS NAME:${package} SECTION:science SHLIBDEPS:ON "DEPENDS:isochron (= VERSION_OF_ALL)")
    string(REGEX MATCH "^([A-Z]+):(.*)$" setting "${setting}")
    set(CPACK_DEBIAN_${component}_PACKAGE_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" PARENT_SCOPE)
  endforeach()
  set(CPACK_COMPONENT_${component}_DESCRIPTION "${text}" PARENT_SCOPE)
endfunction()
isochron_component_package(VTK isochron-readers-vtk
"Readers for Isochron of files that VTK reads: rectilinear, structured and
unstructured grids, AMR, legacy files, Exodus, CGNS, OpenFOAM and EnSight.")
isochron_component_package(MPI isochron-mpi
"Isochron on several computers: walls that show the same cells, and builds by
several processes, through Open MPI.")
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS openmpi-bin)
isochron_component_package(GENERATE isochron-generate
"Makes the demo series of Isochron. It is linked with FFTW, and is therefore
under the GNU General Public License, version 2 or later, as a whole.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libisochron-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libfmt-dev, libglm-dev, libbz2-dev, zlib1g-dev, liblz4-dev, libzstd-dev, libxxhash-dev, libhwy-dev, pkgconf")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"Isochron's index of time-varying volumes as a static library with its headers
and its package for CMake: find the active cells of an isosurface at any step.")

if(TARGET isochron_python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-isochron)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The module is compiled for one minor version of the interpreter, and its readers are the program's.
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(interpreter "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "isochron (= VERSION_OF_ALL), ${interpreter}, python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-xarray, python3-dask, python3-vtk9")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"Isochron's index of time-varying volumes for Python: active cells, surfaces
and values at any step as arrays of NumPy, an xarray Dataset, and pictures.")
  # What the interpreter compiles beside the module goes with it.
  file(WRITE ${CMAKE_BINARY_DIR}/python_package/prerm
    "#!/bin/sh\nset -e\nrm -rf \"$DPKG_ROOT/usr/${ISOCHRON_PYTHON_FOLDER}/isochron/__pycache__\"\n")
  file(CHMOD ${CMAKE_BINARY_DIR}/python_package/prerm
    PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_BINARY_DIR}/python_package/prerm)
endif()

# What Debian asks of each package's documents. Of the libraries that are compiled in, the notices are those of the
# machine that compiles.
set(documents ${CMAKE_BINARY_DIR}/documents)
set(packages isochron libisochron-dev)
install(DIRECTORY ${documents}/isochron/ DESTINATION share/doc/isochron COMPONENT program)
install(DIRECTORY ${documents}/libisochron-dev/ DESTINATION share/doc/libisochron-dev COMPONENT library)
if(TARGET isochron_python)
  list(APPEND ISOCHRON_COMPONENTS python)
endif()
foreach(component IN LISTS ISOCHRON_COMPONENTS)
  string(TOUPPER ${component} upper)
  list(APPEND packages ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(DIRECTORY ${documents}/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}/
    DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component})
endforeach()
add_custom_target(isochron_documents
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DOUT=${documents} -DVERSION=${PROJECT_VERSION} -DMAINTAINER=${CPACK_DEBIAN_PACKAGE_MAINTAINER}
    "-DPACKAGES=${packages}" -P ${CMAKE_SOURCE_DIR}/cmake/documents.cmake
  VERBATIM)
add_dependencies(isochron_program isochron_documents)
include(CPack)
