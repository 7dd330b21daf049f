# Every target of ours is made here, so that all share one set of warnings and the flags that
# keep float arithmetic the same on every compiler.

get_filename_component(SAHL_ROOT ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)

# No contraction into fused multiply-add and no fast-math, anywhere: the host prepares numbers
# (boxes, cameras, tables) that the device's result depends on.
function(sahl_compile_options target)
    target_compile_options(${target} PRIVATE
        -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
        $<$<BOOL:${SAHL_WERROR}>:-Werror>
        $<$<BOOL:${SAHL_NATIVE}>:-march=native>)
endfunction()

# sahl_library(name SOURCES a.cpp ... LINKS other ...): a static library of one host folder.
function(sahl_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${SAHL_ROOT}/host ${SAHL_ROOT}/shaders)
    target_link_libraries(${name} PUBLIC ${ARG_LINKS})
    sahl_compile_options(${name})
endfunction()

# sahl_test(name SOURCES a.cpp ... LINKS other ...): a GoogleTest program, one ctest entry a test.
function(sahl_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_include_directories(${name} PRIVATE ${SAHL_ROOT}/tests)
    target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest GTest::gtest_main)
    sahl_compile_options(${name})
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
