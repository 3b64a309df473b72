# Every library we build on, at the versions of Debian 12. All come with imported targets, so their headers are system
# headers and stay out of our warnings.

# The targets must be known wherever skelgen is linked, also outside this folder when it is part of another project.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

if(SKELGEN_STATIC_PROGRAM)
  set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
endif()

# The core's: headers all of them, and the system's threads.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nanoflann 1.4 REQUIRED CONFIG)
find_package(Spectra 1.0 REQUIRED CONFIG)
find_package(Threads REQUIRED)
set(skelgen_core_libraries nanoflann::nanoflann Spectra::Spectra Threads::Threads)

# Files'. Header-only, used in our sources alone: an installed skelgen does not ask for them, nor for the core's headers.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(FastFloat 3.9 REQUIRED CONFIG)
set(skelgen_build_only nanoflann::nanoflann Spectra::Spectra nlohmann_json::nlohmann_json FastFloat::fast_float)

# More kinds of files, each read where its library is there; a build without says which library it lacks when it meets
# such a file.
# skelgen_find_codec(<NAME> <package> <target> <what it reads>): the option SKELGEN_WITH_<NAME>, on where the library is.
set(skelgen_codec_libraries "")
set(skelgen_codec_definitions "")
set(skelgen_codec_packages "")
macro(skelgen_find_codec NAME package target what)
  find_package(${package} QUIET)
  option(SKELGEN_WITH_${NAME} "Read ${what} (needs ${package})" ${${package}_FOUND})
  if(SKELGEN_WITH_${NAME})
    find_package(${package} REQUIRED)
    list(APPEND skelgen_codec_libraries ${target})
    list(APPEND skelgen_codec_packages ${package})
  endif()
  list(APPEND skelgen_codec_definitions SKELGEN_WITH_${NAME}=$<BOOL:${SKELGEN_WITH_${NAME}}>)
endmacro()
skelgen_find_codec(ZLIB ZLIB ZLIB::ZLIB "and write files compressed by gzip")
skelgen_find_codec(DRACO draco draco::draco "glTF compressed with Draco")
# Not linked but loaded where a file needs them: shared libraries take most of the time in which a program starts.
set(skelgen_linked_codec_libraries ${skelgen_codec_libraries})
set(skelgen_linked_codec_packages ${skelgen_codec_packages})
skelgen_find_codec(MESHOPTIMIZER meshoptimizer meshoptimizer::meshoptimizer "glTF compressed with meshopt")
skelgen_find_codec(ASSIMP assimp assimp::assimp "FBX and DAE")
foreach(name IN ITEMS meshoptimizer assimp)
  string(TOUPPER ${name} NAME)
  if(SKELGEN_WITH_${NAME})
    list(APPEND skelgen_codec_definitions SKELGEN_${NAME}_LIBRARY="$<TARGET_SONAME_FILE_NAME:${name}::${name}>")
  endif()
endforeach()

# For the tests of the adaptor, and an example.
if(SKELGEN_BUILD_TESTS)
  find_package(OpenMesh REQUIRED CONFIG)
endif()

if(SKELGEN_BUILD_RENDER)
  find_package(PNG REQUIRED)
endif()

# CGAL is header-only and brings GMP, MPFR and Boost; it takes Eigen as its solver where one definition says so. Its
# packages that skelgen::synth and the benchmarks use are under the GPL.
if(SKELGEN_BUILD_SYNTH OR SKELGEN_BUILD_TESTS OR SKELGEN_BUILD_BENCH)
  set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
  find_package(CGAL 5.5 REQUIRED)
  include(CGAL_Eigen3_support)
endif()

if(SKELGEN_BUILD_CLI)
  find_package(CLI11 2.1 REQUIRED)
endif()
