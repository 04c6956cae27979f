# Debian packages by `cpack`: the program, the library `index` for developers, and the Python module.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME isochron)
set(CPACK_PACKAGE_VENDOR "The Isochron authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "immersive explorer of time-varying volume data")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET isochron_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Isochron authors <isochron@users.noreply.github.com>")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME isochron)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, libegl1, libgl1, libgl1-mesa-dri")
# Loaded when they are needed, and named by the program where they are missing.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libosmesa6, ${ISOCHRON_PICTURE_PACKAGE}")
file(WRITE ${CMAKE_BINARY_DIR}/dependencies_of_program
  "#!/bin/sh\n# What the programs and modules are linked with, without that.\nexec dpkg-shlibdeps -x${ISOCHRON_PICTURE_PACKAGE} \"$@\"\n")
file(CHMOD ${CMAKE_BINARY_DIR}/dependencies_of_program
  PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
file(WRITE ${CMAKE_BINARY_DIR}/package_settings.cmake
  "set(SHLIBDEPS_EXECUTABLE \"${CMAKE_BINARY_DIR}/dependencies_of_program\")\n")
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_BINARY_DIR}/package_settings.cmake)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, openmpi-bin")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Isochron lets scientists stand inside a series of volumes, such as a
simulation, a scan or a film of a microscope, and drag isovalue and time of
its isosurfaces at display rate: on a desktop, in a CAVE, or in a headset.")

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
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "isochron (= ${PROJECT_VERSION}), ${interpreter}, python3-numpy")
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
add_custom_command(OUTPUT ${documents}/made
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DOUT=${documents} -DVERSION=${PROJECT_VERSION} -DMAINTAINER=${CPACK_DEBIAN_PACKAGE_MAINTAINER}
    -P ${CMAKE_SOURCE_DIR}/cmake/documents.cmake
  DEPENDS LICENSE CHANGELOG.md cmake/documents.cmake VERBATIM)
add_custom_target(isochron_documents DEPENDS ${documents}/made)
add_dependencies(isochron_program isochron_documents)
install(DIRECTORY ${documents}/isochron/ DESTINATION share/doc/isochron COMPONENT program)
install(DIRECTORY ${documents}/libisochron-dev/ DESTINATION share/doc/libisochron-dev COMPONENT library)
if(TARGET isochron_python)
  install(DIRECTORY ${documents}/python3-isochron/ DESTINATION share/doc/python3-isochron COMPONENT python)
endif()
include(CPack)
