# Fails when clang-format would change a file: cmake -DCLANG_FORMAT=... -DROOT=... -P check_format.cmake
file(GLOB_RECURSE files ${ROOT}/models/*.h ${ROOT}/models/*.cc ${ROOT}/scenarios/*.h ${ROOT}/scenarios/*.cc
  ${ROOT}/sim/*.h ${ROOT}/sim/*.cc ${ROOT}/identification/*.h ${ROOT}/identification/*.cc
  ${ROOT}/tools/*.h ${ROOT}/tools/*.cc ${ROOT}/tests/*.h ${ROOT}/tests/*.cc)
execute_process(COMMAND ${CLANG_FORMAT} --dry-run --Werror ${files} RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "run clang-format -i on these:\n${output}")
endif()
