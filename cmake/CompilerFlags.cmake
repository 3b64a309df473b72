# skelgen_flags: what all of our own targets are compiled with. It is never exported: no flag of ours reaches a user.
add_library(skelgen_flags INTERFACE)
target_compile_features(skelgen_flags INTERFACE cxx_std_20)

# Same input, same bytes out on every machine: a fused multiply-add rounds once where two operations round twice.
target_compile_options(skelgen_flags INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-ffp-contract=off>)

target_compile_options(
  skelgen_flags
  INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wnon-virtual-dtor>
            $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # GCC 12 sees faults in std::string's operator+ that are not there
            $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Debug>>:-Wno-maybe-uninitialized> # and everywhere under sanitizers
            $<$<CXX_COMPILER_ID:MSVC>:/W4;/permissive->)

if(SKELGEN_WERROR)
  target_compile_options(
    skelgen_flags
    INTERFACE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Werror>
              $<$<CXX_COMPILER_ID:MSVC>:/WX>
              # GCC reports these from the optimiser, through inlined Eigen and CGAL code, and is often wrong.
              $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized;-Wno-error=array-bounds;-Wno-error=stringop-overflow;-Wno-error=stringop-overread;-Wno-error=free-nonheap-object;-Wno-error=null-dereference>
  )
endif()
