# The plugin loaded from C++ and from MuJoCo's Python moves a model alike, bit for bit:
# -DROLLOUT= program, -DPYTHON=, -DPYTHON_PATH= of mujoco and numpy, -DPLUGIN=, -DSOURCE= this folder, -DOUT= scratch
file(MAKE_DIRECTORY ${OUT})
set(model ${SOURCE}/double_pendulum.xml)
execute_process(COMMAND ${ROLLOUT} ${PLUGIN} ${model} ${OUT}/cpp.bin COMMAND_ERROR_IS_FATAL ANY)
# without MUJOCO_GL=disable the package looks for a display
execute_process(COMMAND ${CMAKE_COMMAND} -E env MUJOCO_GL=disable PYTHONPATH=${PYTHON_PATH} PYTHONDONTWRITEBYTECODE=1
  ${PYTHON} ${SOURCE}/rollout.py ${PLUGIN} ${model} ${OUT}/python.bin COMMAND_ERROR_IS_FATAL ANY)

# 20000 steps of 2 positions, 2 velocities, 4 states, 8 bytes each
file(SIZE ${OUT}/cpp.bin size)
if(NOT size EQUAL 1280000)
  message(FATAL_ERROR "the trajectory has ${size} bytes, not 1280000")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${OUT}/cpp.bin ${OUT}/python.bin RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "the trajectories differ: ${OUT}/cpp.bin, ${OUT}/python.bin")
endif()
