# Installs the build into a fresh prefix, builds the consumer against it and runs both programs.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${work_dir}")
run("${CMAKE_COMMAND}" --install "${build_dir}" --prefix "${work_dir}/prefix")
run("${CMAKE_COMMAND}" -G Ninja -S "${consumer_dir}" -B "${work_dir}/build"
    "-DCMAKE_PREFIX_PATH=${work_dir}/prefix")
run("${CMAKE_COMMAND}" --build "${work_dir}/build")
run("${work_dir}/build/consumer")
run("${work_dir}/prefix/bin/curvefusion" --version)
file(REMOVE_RECURSE "${work_dir}")
