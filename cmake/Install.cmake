# Installs the library, its headers, the program and the package that find_package(skelgen) reads.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/skelgen")

install(TARGETS skelgen EXPORT skelgen-targets FILE_SET HEADERS)
if(TARGET skelgen-cli)
  install(TARGETS skelgen-cli)
endif()
install(EXPORT skelgen-targets NAMESPACE skelgen:: DESTINATION "${package_dir}")

configure_package_config_file(cmake/skelgen-config.cmake.in "${PROJECT_BINARY_DIR}/skelgen-config.cmake"
                              INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/skelgen-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/skelgen-config.cmake" "${PROJECT_BINARY_DIR}/skelgen-config-version.cmake"
        DESTINATION "${package_dir}")
install(DIRECTORY data/schema DESTINATION "${CMAKE_INSTALL_DATADIR}/skelgen")
