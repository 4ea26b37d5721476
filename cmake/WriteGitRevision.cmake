# cmake -D source=DIR -D header=FILE -P WriteGitRevision.cmake: writes the commit that is checked out
# into a header, when it has changed. What is not committed shows as a hash behind "-dirty-". Beside
# it stands a hash of the sources that decide curves and their figures, whatever git knows.
function(git output)
  execute_process(COMMAND git ${ARGN} WORKING_DIRECTORY "${source}" RESULT_VARIABLE failed
                  OUTPUT_VARIABLE text ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    set(text "")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

git(revision rev-parse --short=12 HEAD)
git(changes diff HEAD)
if(NOT revision)
  set(revision "unknown")
elseif(NOT changes STREQUAL "")
  string(SHA1 hash "${changes}")
  string(SUBSTRING "${hash}" 0 8 hash)
  string(APPEND revision "-dirty-${hash}")
endif()

set(method "")
file(GLOB_RECURSE files RELATIVE "${source}"
     "${source}/kernel/*.h" "${source}/kernel/*.cpp" "${source}/capture/*.h" "${source}/capture/*.cpp"
     "${source}/graph/*.h" "${source}/graph/*.cpp" "${source}/fusion/*.h" "${source}/fusion/*.cpp"
     "${source}/experiments/metrics/*.h" "${source}/experiments/metrics/*.cpp"
     "${source}/experiments/studies/reconstruction_run.cpp")
list(SORT files)
foreach(file IN LISTS files)
  file(SHA1 "${source}/${file}" hash)
  string(APPEND method "${file} ${hash}\n")
endforeach()
string(SHA1 method "${method}")
string(SUBSTRING "${method}" 0 16 method)

set(text "#pragma once\n\n#define CURVEFUSION_REVISION \"${revision}\"\n")
string(APPEND text "#define CURVEFUSION_METHOD \"${method}\"\n")
set(written "")
if(EXISTS "${header}")
  file(READ "${header}" written)
endif()
if(NOT written STREQUAL text)
  file(WRITE "${header}" "${text}")
endif()
