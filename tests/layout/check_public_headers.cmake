# Compiles each public header, ROOM/include/warmjoint/*.h below ROOT, by itself with COMPILER, with these folders and OTHERS
# (options, | between them) alone and with all warnings; then the examples at their heads. OUT: folder for what is made.
set(folders)
set(headers)
foreach(room models scenarios sim identification tools)
  list(APPEND folders -I${ROOT}/${room}/include)
  file(GLOB found RELATIVE ${ROOT}/${room}/include ${ROOT}/${room}/include/warmjoint/*.h)
  list(APPEND headers ${found})
  foreach(header ${found})
    set(path_${header} ${ROOT}/${room}/include/${header})
  endforeach()
endforeach()
list(LENGTH headers count)
if(count LESS 10)
  message(FATAL_ERROR "${count} public headers in ${ROOT}")
endif()
string(REPLACE "|" ";" others "${OTHERS}")

function(compile what file)
  execute_process(COMMAND ${COMPILER} -std=c++20 ${ARGN} -fsyntax-only ${folders} ${others} ${file}
    RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} does not compile:\n${error}")
  endif()
endfunction()

set(includes "#include <cstdio>\n")
set(examples "")
foreach(header ${headers})
  file(WRITE ${OUT}/alone.cc "#include <${header}>\n")
  compile("${header} by itself" ${OUT}/alone.cc -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)

  # what is indented by three in the comment before #pragma once
  file(READ ${path_${header}} text)
  string(REGEX REPLACE "#pragma once.*" "" text "\n${text}")
  string(REGEX REPLACE "\n// [^ ][^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n//" "\n" text "${text}")
  string(APPEND includes "#include <${header}>\n")
  string(APPEND examples "{ // ${header}\n${text}\n}\n")
endforeach()
file(WRITE ${OUT}/examples.cc
  "${includes}using namespace warmjoint;\nvoid Examples(const Estimate& estimate) {\n(void)estimate;\n${examples}}\n")
compile("an example of the headers" ${OUT}/examples.cc -Wall -Wextra -Werror -Wno-unused-variable)
message(STATUS "${count} public headers and their examples compile")
