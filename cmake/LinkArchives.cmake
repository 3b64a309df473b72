# skelgen_link_archives(<program> <library>...): of the shared libraries (imported targets or paths) the archives that lie
# beside them are linked in their place, and the compiler's own libraries too: each shared one costs a program half a
# millisecond whenever it starts, whether it is used or not. Where there is no archive, all stays as it is.
function(skelgen_link_archives program)
  if(SKELGEN_STATIC_PROGRAM)
    target_link_options(${program} PRIVATE -static)
  endif()
  if(NOT SKELGEN_LINK_ARCHIVES OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR BUILD_SHARED_LIBS)
    return()
  endif()
  foreach(library IN LISTS ARGN)
    if(TARGET ${library})
      get_target_property(library ${library} LOCATION)
    endif()
    string(REGEX REPLACE "\\.so[.0-9]*$" ".a" archive "${library}")
    if(NOT archive STREQUAL library AND EXISTS "${archive}")
      target_link_libraries(${program} PRIVATE "${archive}")
    endif()
  endforeach()
  # What the archives answer asks for no shared library any more, and of them is kept what is used.
  target_link_options(${program} PRIVATE LINKER:--as-needed,--gc-sections)
  # The address sanitizer has to find the library that throws.
  target_link_options(${program} PRIVATE "$<$<NOT:$<CONFIG:Debug>>:-static-libstdc++;-static-libgcc>")
endfunction()
