# The page's style, script and markup become strings of the library: a report needs no file beside it.

set(page ${CMAKE_CURRENT_SOURCE_DIR}/page)
set(page_scripts ${page}/folds.js ${page}/pictures.js ${page}/viewer.js ${page}/controls.js)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${page}/report.css ${page}/viewer.html ${page_scripts})

# base64_of_hex(RESULT HEX): the bytes that HEX spells, as base64. Six digits make four characters.
function(base64_of_hex result hex)
  set(alphabet "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  string(LENGTH "${hex}" digits)
  set(text "")
  foreach(place RANGE 0 ${digits} 6)
    if(place EQUAL digits)
      break()
    endif()
    string(SUBSTRING "${hex}" ${place} 6 group)
    string(LENGTH "${group}" length)
    string(SUBSTRING "${group}00000" 0 6 group)
    foreach(shift 18 12 6 0)
      math(EXPR index "(0x${group} >> ${shift}) & 63")
      string(SUBSTRING "${alphabet}" ${index} 1 character)
      string(APPEND text "${character}")
    endforeach()
    if(length LESS 6)
      # One byte fills two characters, two fill three.
      math(EXPR kept "${length} / 2 + 1")
      string(LENGTH "${text}" all)
      math(EXPR begin "${all} - 4 + ${kept}")
      string(SUBSTRING "${text}" 0 ${begin} text)
      foreach(missing RANGE ${kept} 3)
        string(APPEND text "=")
      endforeach()
    endif()
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

file(READ ${page}/report.css PAGE_STYLE)
file(READ ${page}/viewer.html VIEWER_MARKUP)

# The scripts as one, and its hash.
set(PAGE_SCRIPT "(() => {
'use strict';
")
foreach(file IN LISTS page_scripts)
  file(READ ${file} text)
  string(APPEND PAGE_SCRIPT "${text}
")
endforeach()
string(APPEND PAGE_SCRIPT "})();
")
string(SHA256 sha256 "${PAGE_SCRIPT}")
base64_of_hex(PAGE_SCRIPT_HASH ${sha256})
configure_file(${page}/page.cpp.in page.cpp @ONLY)
