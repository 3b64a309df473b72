# Every library we build on, at the versions of Debian 12. All come with imported targets, so their headers are system
# headers and stay out of our warnings.

# The targets must be known wherever skelgen is linked, also outside this folder when it is part of another project.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(OpenMesh REQUIRED CONFIG)
find_package(Spectra 1.0 REQUIRED CONFIG)
find_package(nanoflann 1.4 REQUIRED CONFIG)
find_package(FastFloat 3.9 REQUIRED CONFIG)
find_package(PNG REQUIRED)

# CGAL is header-only and brings GMP, MPFR and Boost; it takes Eigen as its solver where one definition says so.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL 5.5 REQUIRED)
include(CGAL_Eigen3_support)

if(SKELGEN_BUILD_CLI)
  find_package(CLI11 2.1 REQUIRED)
endif()

# Header-only, used in our sources alone: an installed skelgen does not ask for them.
set(skelgen_build_only skelgen_flags nlohmann_json::nlohmann_json Spectra::Spectra nanoflann::nanoflann
                       FastFloat::fast_float)
