# Installs BUILD into a prefix under OUT, moves the prefix, and builds and runs the consumer in SOURCE against it.
set(prefix ${OUT}/moved)
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${OUT}/prefix --strip
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${OUT}/prefix ${prefix})

# the public headers are all that is installed beside MuJoCo's
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*)
list(FILTER headers EXCLUDE REGEX "^(mujoco/.*|warmjoint/[a-z_]+\\.h)$")
if(headers)
  message(FATAL_ERROR "these are installed and no part of the interface: ${headers}")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${OUT}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${OUT}/build COMMAND_ERROR_IS_FATAL ANY)

# who links the library gets its headers, Eigen's and MuJoCo's, and no folder or option of what else it is made of
file(READ ${OUT}/build/compile_commands.json commands)
if(commands MATCHES "hdf5|nlohmann|-Werror|-Wall")
  message(FATAL_ERROR "the consumer is compiled with more than the interface: ${commands}")
endif()

# the installed program makes a log; consumer and program write the same model of it, which MuJoCo loads
execute_process(COMMAND ${prefix}/bin/warmjoint simulate ${SOURCE}/scenario.yaml -o ${OUT}/log COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT}/build/consumer ${OUT}/log/recording.csv ${OUT}/friction.xml COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${prefix}/bin/warmjoint identify ${OUT}/log/recording.csv --mjcf ${OUT}/same.xml
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${OUT}/friction.xml ${OUT}/same.xml COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT}/build/load_model ${OUT}/friction.xml COMMAND_ERROR_IS_FATAL ANY)

# bad input ends as a sentence that names the file
execute_process(COMMAND ${OUT}/build/consumer ${OUT}/absent.csv ${OUT}/none.xml RESULT_VARIABLE status ERROR_VARIABLE error)
if(NOT status EQUAL 2 OR NOT error MATCHES "absent\\.csv" OR EXISTS ${OUT}/none.xml)
  message(FATAL_ERROR "an absent log ends with ${status}: ${error}")
endif()

# completion is where bash looks for it
if(NOT EXISTS ${prefix}/share/bash-completion/completions/warmjoint)
  message(FATAL_ERROR "no completion is installed")
endif()

# the installed program finds its robots and its plugin's library
execute_process(COMMAND ${prefix}/bin/warmjoint list robots COMMAND_ERROR_IS_FATAL ANY)
