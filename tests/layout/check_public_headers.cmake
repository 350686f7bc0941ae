# Compiles each header of HEADERS/warmjoint by itself with COMPILER, with that folder alone, as C++17 and with all warnings.
file(GLOB headers RELATIVE ${HEADERS} ${HEADERS}/warmjoint/*.h)
foreach(header ${headers})
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo "#include <${header}>"
    COMMAND ${COMPILER} -std=c++17 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -fsyntax-only -I${HEADERS} -x c++ -
    RESULTS_VARIABLE results ERROR_VARIABLE error)
  if(NOT results STREQUAL "0;0")
    message(FATAL_ERROR "${header} does not compile by itself:\n${error}")
  endif()
endforeach()
list(LENGTH headers count)
if(count LESS 6)
  message(FATAL_ERROR "${count} headers in ${HEADERS}/warmjoint")
endif()
message(STATUS "${count} public headers compile by themselves")
