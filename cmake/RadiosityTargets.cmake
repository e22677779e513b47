# One library a folder. Its sources are the folder's *.cpp, so that a new implementation needs no edit here.

add_library(radiosity_options INTERFACE)
target_compile_options(radiosity_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual -Wredundant-decls
  -Werror -fno-math-errno -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Batches fill GCC's heap many times over: collecting at 500 MB in place of 128 saves a sixth of the compilation.
  target_compile_options(radiosity_options INTERFACE --param=ggc-min-heapsize=500000)
endif()
if(RADIOSITY_SANITIZE)
  # Checks of every dereference cost half the compilation; a null pointer ends in a report of the address sanitizer anyway, and
  # only the folders that cast pointers to numbers can misalign them. Of tests and the experiments' drivers only the calls
  # into the libraries are looked at for undefined arithmetic. GCC's flow analysis does not see through the instrumentation.
  target_compile_options(radiosity_options INTERFACE -fsanitize=${RADIOSITY_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all -fno-sanitize=null,object-size,vptr -Wno-maybe-uninitialized
                         $<$<NOT:$<BOOL:$<TARGET_PROPERTY:RADIOSITY_CASTS_POINTERS>>>:-fno-sanitize=alignment>
                         $<$<BOOL:$<TARGET_PROPERTY:RADIOSITY_ADDRESSES_ONLY>>:-fno-sanitize=undefined>)
  # The sanitizer calls dlopen in the program's place: modules are found through RPATH, which counts for every caller.
  target_link_options(radiosity_options INTERFACE -fsanitize=${RADIOSITY_SANITIZE} LINKER:--disable-new-dtags)
endif()

# radiosity_library(NAME PUBLIC targets... PRIVATE targets...)
function(radiosity_library name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  set(target radiosity_${name})
  add_library(${target} ${sources})
  add_library(radiosity::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  if(name MATCHES "^(foundation|kernels|compression|gpu)$")
    set_target_properties(${target} PROPERTIES RADIOSITY_CASTS_POINTERS ON)
  endif()
  if(name STREQUAL experiments)
    set_target_properties(${target} PROPERTIES RADIOSITY_ADDRESSES_ONLY ON)
  endif()
  if(CMAKE_BUILD_TYPE STREQUAL Release AND name MATCHES "^(scene|solvers|experiments)$")
    target_compile_options(${target} PRIVATE -O2)  # few loops of their own: -O3 costs a third of the compilation
  endif()
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/radiosity>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:radiosity_options>)
  install(TARGETS ${target} EXPORT radiosity ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/radiosity/${name}
          FILES_MATCHING PATTERN "*.hpp")
endfunction()

# radiosity_test(NAME targets... [SLOW tests...]): every *.cpp of the current folder in one GoogleTest program. The tests named
# after SLOW (GoogleTest's patterns) get the label "slow" instead of NAME: sanitizers leave them out, and run the others in one
# process, since an instrumented program takes longer to start than most tests take.
function(radiosity_test name)
  cmake_parse_arguments(arg "" "" "SLOW" ${ARGN})
  list(JOIN arg_SLOW ":" slow)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  set(target radiosity_${name}_tests)
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE ${arg_UNPARSED_ARGUMENTS} GTest::gtest_main radiosity_options)
  set_target_properties(${target} PROPERTIES RADIOSITY_ADDRESSES_ONLY ON)
  if(RADIOSITY_SANITIZE)  # a test takes longer to compile than to run
    target_compile_options(${target} PRIVATE -O0)
  elseif(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${target} PRIVATE -O1)
  endif()
  target_compile_definitions(${target} PRIVATE RADIOSITY_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(RADIOSITY_SANITIZE)
    add_test(NAME ${name} COMMAND ${target} --gtest_brief=1 "--gtest_filter=-${slow}")
    set_tests_properties(${name} PROPERTIES LABELS ${name} TIMEOUT 900)
    return()
  endif()
  gtest_discover_tests(${target} TEST_PREFIX "${name}." TEST_FILTER "-${slow}" DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS ${name} TIMEOUT 600)
  if(arg_SLOW)
    gtest_discover_tests(${target} TEST_PREFIX "${name}." TEST_FILTER "${slow}" TEST_LIST ${target}_SLOW DISCOVERY_TIMEOUT 60
                         PROPERTIES LABELS slow TIMEOUT 600)
  endif()
endfunction()
