# Installs the build into a fresh prefix, builds the examples against it and runs what came of it.
function(run)
  cmake_parse_arguments(arg "" "EXPECT" "COMMAND" ${ARGN})
  execute_process(COMMAND ${arg_COMMAND} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0 OR NOT output MATCHES "${arg_EXPECT}")
    message(FATAL_ERROR "${arg_COMMAND}\nended with ${result}, expected was '${arg_EXPECT}':\n"
                        "${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${work_dir}")
run(COMMAND "${CMAKE_COMMAND}" --install "${build_dir}" --prefix "${work_dir}/prefix")
run(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${examples_dir}" -B "${work_dir}/build"
            "-DCMAKE_PREFIX_PATH=${work_dir}/prefix" -DCMAKE_BUILD_TYPE=Release)
run(COMMAND "${CMAKE_COMMAND}" --build "${work_dir}/build")
set(curvefusion "${work_dir}/prefix/bin/curvefusion")

# Each public header stands alone.
file(GLOB headers RELATIVE "${work_dir}/prefix/include" "${work_dir}/prefix/include/curvefusion/*.h")
list(LENGTH headers count)
if(NOT count EQUAL 12)
  message(FATAL_ERROR "${count} public headers: ${headers}")
endif()
set(sources "")
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER "${header}" name)
  file(WRITE "${work_dir}/headers/${name}.cpp" "#include <${header}>\n")
  string(APPEND sources " ${name}.cpp")
endforeach()
file(WRITE "${work_dir}/headers/CMakeLists.txt" "
cmake_minimum_required(VERSION 3.22)
project(headers LANGUAGES CXX)
find_package(curvefusion REQUIRED)
add_library(headers OBJECT ${sources})
target_link_libraries(headers PRIVATE curvefusion::experiments)
target_compile_options(headers PRIVATE -fsyntax-only)
")
run(COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${work_dir}/headers" -B "${work_dir}/headers_build"
            "-DCMAKE_PREFIX_PATH=${work_dir}/prefix")
run(COMMAND "${CMAKE_COMMAND}" --build "${work_dir}/headers_build")
run(COMMAND "${curvefusion}" --version EXPECT "^[0-9]+\\.[0-9]+\\.[0-9]+")

run(COMMAND "${work_dir}/build/graph_to_mesh" "${work_dir}/cross.ply" EXPECT "5 nodes, 4 edges")
run(COMMAND "${curvefusion}" mesh --check "${work_dir}/cross.ply" EXPECT "watertight")

# A rod of 300 mm whose surface is points in four rows.
set(cloud "")
foreach(millimetre RANGE 100 399)
  foreach(row "0 0" "0.004 0" "0 0.004" "0.004 0.004")
    string(APPEND cloud "0.${millimetre} ${row}\n")
  endforeach()
endforeach()
file(WRITE "${work_dir}/rod.xyz" "${cloud}")
run(COMMAND "${work_dir}/build/contract_cloud" "${work_dir}/rod.xyz" "${work_dir}/rod.json"
    EXPECT "1 curves, 0\\.(2[89]|30)")

run(COMMAND "${curvefusion}" simulate cubeframe -o "${work_dir}/scan" --sensor ideal --frames 12
            --quiet)
file(WRITE "${work_dir}/settings.toml" "[radius]\nmax_frames = 5\n")
run(COMMAND "${work_dir}/build/reconstruct" "${work_dir}/scan" "${work_dir}/settings.toml"
            "${work_dir}/skeleton.json" EXPECT "curves, ")
run(COMMAND "${curvefusion}" graph "${work_dir}/skeleton.json" --validate EXPECT "is valid")
file(WRITE "${work_dir}/settings.toml" "[radius]\nmax_frame = 5\n")
execute_process(COMMAND "${work_dir}/build/reconstruct" "${work_dir}/scan"
                        "${work_dir}/settings.toml" "${work_dir}/skeleton.json"
                RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 2 OR NOT output MATCHES "max_frames")
  message(FATAL_ERROR "a wrong setting is not told: ${result}, ${output}")
endif()
file(REMOVE_RECURSE "${work_dir}")
