# What `cmake --install` puts where. The program finds its readers and modules from its own place, so that the tree
# works under any prefix and may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(private libexec/isochron) # where file_of_program looks, from the program's folder: ../libexec/isochron
install(TARGETS isochron RUNTIME COMPONENT program)
get_directory_property(readers DIRECTORY index BUILDSYSTEM_TARGETS)
list(FILTER readers INCLUDE REGEX ^isochron-reader-)
# What stands in packages of its own, see index/system/module.cpp.
set(component_of_isochron-reader-vtk vtk)
set(component_of_isochron-reader-mesh vtk)
set(component_of_isochron_mpi mpi)
set(component_of_isochron-generate generate)
foreach(part IN LISTS readers ITEMS isochron-generate isochron-reader-image isochron_mpi isochron_images isochron_pages isochron_glfw isochron_links isochron_site)
  if(TARGET ${part})
    set(component program)
    if(DEFINED component_of_${part})
      set(component ${component_of_${part}})
      list(APPEND ISOCHRON_COMPONENTS ${component})
    endif()
    install(TARGETS ${part} RUNTIME DESTINATION ${private} COMPONENT ${component}
      LIBRARY DESTINATION ${private} COMPONENT ${component})
  endif()
endforeach()
list(REMOVE_DUPLICATES ISOCHRON_COMPONENTS)

# The Python module finds the program's readers from its own place, too.
if(TARGET isochron_python)
  install(TARGETS isochron_python LIBRARY DESTINATION ${ISOCHRON_PYTHON_FOLDER}/isochron COMPONENT python)
  install(DIRECTORY ${ISOCHRON_PYTHON_INFO} DESTINATION ${ISOCHRON_PYTHON_FOLDER} COMPONENT python)
  install(DIRECTORY app/python/isochron DESTINATION ${ISOCHRON_PYTHON_FOLDER} COMPONENT python
    PATTERN __pycache__ EXCLUDE)
endif()

# Manual pages and completions are what the program says of itself.
set(help_files ${CMAKE_BINARY_DIR}/help)
add_custom_command(OUTPUT ${help_files}/made
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${help_files}
  COMMAND isochron manual ${help_files}/man1
  COMMAND gzip -9nr ${help_files}/man1
  COMMAND isochron completion bash > ${help_files}/isochron
  COMMAND isochron completion zsh > ${help_files}/_isochron
  COMMAND isochron completion fish > ${help_files}/isochron.fish
  COMMAND ${CMAKE_COMMAND} -E touch ${help_files}/made
  DEPENDS isochron COMMENT "Writing manual pages and completions" VERBATIM)
add_custom_target(isochron_help DEPENDS ${help_files}/made)
add_dependencies(isochron_program isochron_help)

install(DIRECTORY ${help_files}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${help_files}/isochron DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${help_files}/_isochron DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${help_files}/isochron.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(FILES packaging/isochron.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
install(FILES packaging/isochron.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT program)
install(FILES packaging/isochron.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/isochron COMPONENT program)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program PATTERN results EXCLUDE)

# The floor `index` for other programs: find_package(Isochron), Isochron::index.
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/isochron)
target_include_directories(index INTERFACE $<INSTALL_INTERFACE:${headers}>)
target_compile_features(index INTERFACE cxx_std_20)
target_compile_definitions(index INTERFACE $<INSTALL_INTERFACE:GLM_FORCE_XYZW_ONLY>)
foreach(part index index_readers index_volume)
  set_target_properties(${part} PROPERTIES OUTPUT_NAME isochron_${part})
endforeach()
install(TARGETS index index_readers index_volume EXPORT IsochronTargets ARCHIVE DESTINATION lib COMPONENT library)
install(DIRECTORY index DESTINATION ${headers} COMPONENT library FILES_MATCHING PATTERN "*.h"
  PATTERN decoders EXCLUDE PATTERN "*_inl.h" EXCLUDE)
set(package lib/cmake/Isochron)
install(EXPORT IsochronTargets NAMESPACE Isochron:: DESTINATION ${package} COMPONENT library)
configure_package_config_file(packaging/IsochronConfig.cmake.in ${CMAKE_BINARY_DIR}/IsochronConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/IsochronConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/IsochronConfig.cmake ${CMAKE_BINARY_DIR}/IsochronConfigVersion.cmake
  DESTINATION ${package} COMPONENT library)
