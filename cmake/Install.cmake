# Installs the libraries, their headers, the program and the package that find_package(skelgen) reads.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/skelgen")

# One export set a part: whoever finds skelgen alone needs no library of a part.
install(TARGETS skelgen_core EXPORT skelgen-targets FILE_SET HEADERS FILE_SET details FILE_SET definitions)
install(TARGETS skelgen EXPORT skelgen-targets FILE_SET HEADERS FILE_SET details)
install(EXPORT skelgen-targets NAMESPACE skelgen:: DESTINATION "${package_dir}")
foreach(part IN ITEMS render evaluation synth)
  if(TARGET skelgen_${part})
    install(TARGETS skelgen_${part} EXPORT skelgen-${part}-targets FILE_SET HEADERS FILE_SET details)
    install(EXPORT skelgen-${part}-targets NAMESPACE skelgen:: DESTINATION "${package_dir}")
  endif()
endforeach()
if(TARGET skelgen-cli)
  install(TARGETS skelgen-cli)
endif()

if(BUILD_SHARED_LIBS)
  set(SKELGEN_STATIC OFF)
else()
  set(SKELGEN_STATIC ON)
endif()
list(JOIN skelgen_linked_codec_packages " " skelgen_codec_packages)
configure_package_config_file(cmake/skelgen-config.cmake.in "${PROJECT_BINARY_DIR}/skelgen-config.cmake"
                              INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/skelgen-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/skelgen-config.cmake" "${PROJECT_BINARY_DIR}/skelgen-config-version.cmake"
        DESTINATION "${package_dir}")
install(DIRECTORY data/schema data/templates DESTINATION "${CMAKE_INSTALL_DATADIR}/skelgen")
