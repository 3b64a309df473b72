# cmake -D INCLUDE_DIR=<include> -P check_umbrella.cmake
# Fails unless skelgen/skelgen.hpp includes every public header; adaptors to other mesh libraries are for those who have
# these libraries.
file(READ "${INCLUDE_DIR}/skelgen/skelgen.hpp" umbrella)
file(GLOB_RECURSE headers RELATIVE "${INCLUDE_DIR}" "${INCLUDE_DIR}/skelgen/*.hpp")
list(REMOVE_ITEM headers skelgen/skelgen.hpp)
list(FILTER headers EXCLUDE REGEX "_adaptor\\.hpp$")

set(missing "")
foreach(header IN LISTS headers)
  string(FIND "${umbrella}" "#include <${header}>" position)
  if(position EQUAL -1)
    list(APPEND missing "${header}")
  endif()
endforeach()
if(missing)
  list(JOIN missing "\n  " text)
  message(FATAL_ERROR "skelgen/skelgen.hpp does not include\n  ${text}")
endif()
