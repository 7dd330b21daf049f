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
    # Instrumented by a sanitizer, GCC 12 takes members of std::regex for uninitialized.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
        target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
endfunction()

# sahl_library(name SOURCES a.cpp ... LINKS other ...): a static library of one host folder.
function(sahl_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${SAHL_ROOT}/host ${SAHL_ROOT}/shaders)
    target_link_libraries(${name} PUBLIC ${ARG_LINKS})
    sahl_compile_options(${name})
endfunction()

# Manifests of the drivers that device tests run on: Mesa's lavapipe, and SwiftShader once
# `tools/drivers swiftshader` has fetched it. Looked for at every configuration unless given.
set(SAHL_TEST_DRIVERS "" CACHE STRING "manifests of the Vulkan drivers for device tests; empty: look for them")
function(sahl_find_test_drivers output)
    set(drivers ${SAHL_TEST_DRIVERS})
    if(NOT drivers)
        file(GLOB drivers /usr/share/vulkan/icd.d/lvp_icd*.json)
        file(GLOB_RECURSE swiftshader ${SAHL_ROOT}/.drivers/*/vk_swiftshader_icd.json)
        list(APPEND drivers ${swiftshader})
    endif()
    set(${output} ${drivers} PARENT_SCOPE)
endfunction()

# sahl_test(name [LONG] [WHOLE Suite ...] SOURCES a.cpp ... LINKS other ...): a GoogleTest program, one ctest entry a
# test, labelled with the folder of tests/ it is in.
#   LONG    tests of suites called Long... take minutes: they get the label FOLDER-long
#   WHOLE   suites whose tests share what is dear to make: one entry a suite; none of them may be skipped
function(sahl_test name)
    cmake_parse_arguments(ARG "LONG" "" "SOURCES;LINKS;WHOLE" ${ARGN})
    sahl_test_program(${name} "${ARG_SOURCES}" "${ARG_LINKS}")
    sahl_discover(${name} "${ARG_LONG}" "${ARG_WHOLE}" "" "")
endfunction()

# sahl_device_test(name ...), arguments as above: needs a Vulkan device, so every test runs once a
# driver, under the names lavapipe.* and swiftshader.*. Where no such driver is found the tests run on
# what the loader offers, and fail if that is nothing. Nothing is built with SAHL_WITH_VULKAN=OFF.
#   SLOW  tests, by patterns, that take SwiftShader long and other drivers not: there they are long ones
#   HEAVY tests that take every driver long, mostly to compile kernels of many settings
function(sahl_device_test name)
    if(NOT SAHL_WITH_VULKAN)
        return()
    endif()
    cmake_parse_arguments(ARG "LONG" "" "SOURCES;LINKS;WHOLE;SLOW;HEAVY" ${ARGN})
    sahl_test_program(${name} "${ARG_SOURCES};${SAHL_ROOT}/tests/support/driver_leaks.cpp" "${ARG_LINKS}")
    sahl_find_test_drivers(drivers)
    foreach(manifest ${drivers})
        set(driver lavapipe)
        if(manifest MATCHES "/(swiftshader|lavapipe25)/")
            set(driver ${CMAKE_MATCH_1})
        endif()
        set(slow ${ARG_HEAVY})
        if(driver STREQUAL swiftshader)
            list(APPEND slow ${ARG_SLOW})
        endif()
        sahl_discover(${name} "${ARG_LONG}" "${ARG_WHOLE}" "${slow}" "${driver}." ENVIRONMENT VK_DRIVER_FILES=${manifest})
    endforeach()
    if(NOT drivers)
        sahl_discover(${name} "${ARG_LONG}" "${ARG_WHOLE}" "${ARG_HEAVY}" "")
    endif()
endfunction()

function(sahl_test_program name sources links)
    add_executable(${name} ${sources})
    target_include_directories(${name} PRIVATE ${SAHL_ROOT}/tests)
    target_link_libraries(${name} PRIVATE ${links} sahl_test_support GTest::gtest GTest::gtest_main)
    sahl_compile_options(${name})
    sahl_add_to_folder(${name})
endfunction()

# sahl_add_to_folder(name): builds a program of a folder of tests/ with the target tests_FOLDER too.
function(sahl_add_to_folder name)
    get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
    if(NOT TARGET tests_${folder})
        add_custom_target(tests_${folder})
    endif()
    add_dependencies(tests_${folder} ${name})
endfunction()

function(sahl_discover name long whole slow prefix)
    get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
    set(others)
    foreach(suite ${whole})
        list(APPEND others "${suite}.*")
        set(label ${folder})
        if("${suite}.*" IN_LIST slow)
            list(REMOVE_ITEM slow "${suite}.*")
            set(label ${folder}-long)
        endif()
        add_test(NAME ${prefix}${suite} COMMAND ${name} --gtest_filter=${suite}.*)
        set_tests_properties(${prefix}${suite} PROPERTIES TIMEOUT 900 LABELS ${label}
            FAIL_REGULAR_EXPRESSION "\\[  SKIPPED \\]" ${ARGN})
    endforeach()
    set(taking_long ${slow})
    if(long)
        list(APPEND taking_long "Long*")
    endif()
    if(taking_long)
        list(APPEND others ${taking_long})
        list(JOIN taking_long ":" taking_long)
        gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_PREFIX "${prefix}" TEST_FILTER "${taking_long}"
            TEST_LIST ${name}_${prefix}long PROPERTIES TIMEOUT 3600 LABELS ${folder}-long ${ARGN})
    endif()
    set(filter)
    if(others)
        list(JOIN others ":" others)
        set(filter TEST_FILTER "-${others}")
    endif()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_PREFIX "${prefix}" ${filter}
        TEST_LIST ${name}_${prefix}tests PROPERTIES TIMEOUT 900 LABELS ${folder} ${ARGN})
endfunction()
