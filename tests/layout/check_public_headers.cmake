# Compiles each header of HEADERS/warmjoint by itself with COMPILER, with that folder alone, as C++17 and with all warnings;
# then the examples at their heads, as C++20. OUT: folder for what is made on the way.
file(GLOB headers RELATIVE ${HEADERS} ${HEADERS}/warmjoint/*.h)
list(LENGTH headers count)
if(count LESS 6)
  message(FATAL_ERROR "${count} headers in ${HEADERS}/warmjoint")
endif()

function(compile what file standard)
  execute_process(COMMAND ${COMPILER} -std=${standard} ${ARGN} -fsyntax-only -I${HEADERS} ${file}
    RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} does not compile:\n${error}")
  endif()
endfunction()

set(includes "#include <cstdio>\n")
set(examples "")
foreach(header ${headers})
  file(WRITE ${OUT}/alone.cc "#include <${header}>\n")
  compile("${header} by itself" ${OUT}/alone.cc c++17 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)

  # what is indented by three in the comment before #pragma once
  file(READ ${HEADERS}/${header} text)
  string(REGEX REPLACE "#pragma once.*" "" text "\n${text}")
  string(REGEX REPLACE "\n// [^ ][^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n//" "\n" text "${text}")
  string(APPEND includes "#include <${header}>\n")
  string(APPEND examples "{ // ${header}\n${text}\n}\n")
endforeach()
file(WRITE ${OUT}/examples.cc
  "${includes}using namespace warmjoint::api;\nvoid Examples(const Estimate& estimate) {\n(void)estimate;\n${examples}}\n")
compile("an example of the headers" ${OUT}/examples.cc c++20 -Wall -Wextra -Werror -Wno-unused-variable)
message(STATUS "${count} public headers and their examples compile")
