# Installs BUILD into a prefix under OUT, moves the prefix, and builds and runs the consumer in SOURCE against it.
set(prefix ${OUT}/moved)
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${OUT}/prefix --strip
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${OUT}/prefix ${prefix})

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${OUT}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${OUT}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT}/build/consumer COMMAND_ERROR_IS_FATAL ANY)

# the installed program finds its robots and its plugin's library
execute_process(COMMAND ${prefix}/bin/warmjoint list robots COMMAND_ERROR_IS_FATAL ANY)
