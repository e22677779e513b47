# Installs the build into a prefix, moves the prefix (an installed package must not know where it was made), then configures,
# builds and runs the consumer against it.
file(REMOVE_RECURSE ${WORK_FOLDER})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${WORK_FOLDER}/made)
file(RENAME ${WORK_FOLDER}/made ${WORK_FOLDER}/moved)

# Nothing in the package may point back to the build or its sources.
file(GLOB_RECURSE package_files ${WORK_FOLDER}/moved/*.cmake)
get_filename_component(source_folder ${CONSUMER_FOLDER}/../../.. ABSOLUTE)
foreach(file ${package_files})
  file(READ ${file} content)
  foreach(folder ${source_folder} ${BUILD_FOLDER} ${WORK_FOLDER})
    string(FIND "${content}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names ${folder}: the package cannot be moved")
    endif()
  endforeach()
endforeach()

set(flags "")
if(SANITIZE)
  set(flags -fsanitize=${SANITIZE})
endif()
run(${CMAKE_COMMAND} -S ${CONSUMER_FOLDER} -B ${WORK_FOLDER}/build -G Ninja -D CMAKE_BUILD_TYPE=${BUILD_TYPE}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} "-DCMAKE_CXX_FLAGS=${flags}"
    -D CMAKE_PREFIX_PATH=${WORK_FOLDER}/moved -D README=${source_folder}/README.md)
run(${CMAKE_COMMAND} --build ${WORK_FOLDER}/build)
run(${WORK_FOLDER}/build/consumer ${WORK_FOLDER}/comparison.json)
message("${output}")
run(${WORK_FOLDER}/build/readme_example)
run(${WORK_FOLDER}/moved/bin/radiosity info cube)
