# Every library we build on, at the versions of Debian 12. All come with imported targets, so their headers are system
# headers and stay out of our warnings.

# The targets must be known wherever skelgen is linked, also outside this folder when it is part of another project.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

# The core's: headers all of them, but for OpenMesh's core.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMesh REQUIRED CONFIG)
find_package(nanoflann 1.4 REQUIRED CONFIG)
set(skelgen_core_libraries nanoflann::nanoflann OpenMeshCore)

# Files'. Header-only, used in our sources alone: an installed skelgen does not ask for them, nor for the core's headers.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(FastFloat 3.9 REQUIRED CONFIG)
set(skelgen_build_only nanoflann::nanoflann nlohmann_json::nlohmann_json FastFloat::fast_float)

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
