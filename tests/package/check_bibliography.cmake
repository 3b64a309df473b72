# cmake -D SOURCE_DIR=<project> -P check_bibliography.cmake
# Fails unless every source that a comment of include/, src/ or apps/ names by its key (LF20, Au08, TAOZ12) is an entry
# of docs/bibliography.md, and every entry is named by a comment.
cmake_minimum_required(VERSION 3.25)

# One to five letters of which the first is a capital, two digits: initials or the beginning of a name, and the year.
set(key "[A-Z][A-Za-z][A-Za-z]?[A-Za-z]?[A-Za-z]?[0-9][0-9]")
# Words of that form which are no sources.
set(no_keys CLI11 UTF16 UTF32)

# - **KEY** Authors: *Title*. Venue year. ...
file(READ "${SOURCE_DIR}/docs/bibliography.md" text)
string(REGEX REPLACE "[][;]" " " text "${text}") # what CMake's lists trip over
string(REGEX MATCHALL "\n- [^\n]*" heads "${text}")
string(REGEX MATCHALL "\n- \\*\\*${key}\\*\\* [^*]+: \\*[^*]+\\*[.][^*]*[12][0-9][0-9][0-9][.]" whole "${text}")
set(entries "")
foreach(entry IN LISTS whole)
  string(REGEX MATCH "${key}" entry "${entry}")
  list(APPEND entries "${entry}")
endforeach()
foreach(head IN LISTS heads)
  string(STRIP "${head}" head)
  if(NOT head MATCHES "^- \\*\\*(${key})\\*\\*" OR NOT CMAKE_MATCH_1 IN_LIST entries)
    message(SEND_ERROR "docs/bibliography.md: no `- **KEY** Authors: *Title*. Venue year.`: ${head}")
  endif()
endforeach()
if(NOT entries)
  message(FATAL_ERROR "docs/bibliography.md has no entries")
endif()

set(files "")
foreach(folder IN ITEMS include src apps)
  file(GLOB_RECURSE found RELATIVE "${SOURCE_DIR}" "${SOURCE_DIR}/${folder}/*.hpp" "${SOURCE_DIR}/${folder}/*.cpp")
  list(APPEND files ${found})
endforeach()
if(NOT files)
  message(FATAL_ERROR "no sources found in ${SOURCE_DIR}")
endif()

set(named "")
set(unknown "")
foreach(file IN LISTS files)
  file(READ "${SOURCE_DIR}/${file}" text)
  string(REGEX REPLACE "[][;]" " " text "${text}") # what CMake's lists trip over
  string(REGEX REPLACE "\"([^\"\\\n]|\\\\.)*\"" "" text "${text}") # string literals may hold // and anything else
  string(REGEX MATCHALL "//[^\n]*|/\\*([^*]|\\*+[^*/])*\\*+/" comments "${text}")
  string(REGEX REPLACE "`[^`]*`" "" comments "${comments}") # code in a comment names no source
  # Whole words, so that no part of a longer name, of U+2028 or of a file's name is taken for a key.
  string(REGEX MATCHALL "[A-Za-z0-9_+]+([.][a-z]+)?" words "${comments}")
  list(FILTER words INCLUDE REGEX "^${key}$")
  list(REMOVE_DUPLICATES words)
  list(REMOVE_ITEM words ${no_keys})
  foreach(word IN LISTS words)
    list(APPEND named "${word}")
    if(NOT word IN_LIST entries)
      string(APPEND unknown "\n  ${word} in ${file}")
    endif()
  endforeach()
endforeach()

list(REMOVE_DUPLICATES named)
set(unused "${entries}")
list(REMOVE_ITEM unused ${named})

list(LENGTH entries count)
list(REMOVE_DUPLICATES entries)
list(LENGTH entries distinct)
if(NOT count EQUAL distinct)
  message(SEND_ERROR "docs/bibliography.md has an entry twice")
endif()
if(unknown)
  message(SEND_ERROR "named, but no entry of docs/bibliography.md:${unknown}")
endif()
if(unused)
  list(JOIN unused " " text)
  message(SEND_ERROR "entries of docs/bibliography.md that no comment names: ${text}")
endif()
