# cmake -D source=DIR -D header=FILE -P WriteGitRevision.cmake: writes the commit that is checked out
# into a header, when it has changed. What is not committed shows as a hash behind "-dirty-".
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

set(text "#pragma once\n\n#define CURVEFUSION_REVISION \"${revision}\"\n")
set(written "")
if(EXISTS "${header}")
  file(READ "${header}" written)
endif()
if(NOT written STREQUAL text)
  file(WRITE "${header}" "${text}")
endif()
