# Configures the project in SOURCE, which holds WARMJOINT, below OUT; with BUILD also builds it, and runs
# it on a log that PROGRAM makes.
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${OUT} -G ${GENERATOR} -DWARMJOINT=${WARMJOINT}
  -DMUJOCO_ROOT=${MUJOCO_ROOT} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
if(BUILD)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${OUT} --target parent COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${PROGRAM} simulate ${WARMJOINT}/tests/consumer/scenario.yaml -o ${OUT}/log
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${OUT}/parent ${OUT}/log/recording.csv ${OUT}/friction.xml COMMAND_ERROR_IS_FATAL ANY)
endif()
