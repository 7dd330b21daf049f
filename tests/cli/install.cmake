# cmake -DBUILD=folder -DBINDIR=bin -DVERSION=x -P install.cmake: what is installed runs from where it is.
set(prefix ${BUILD}/install-test)
file(REMOVE_RECURSE ${prefix})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${prefix}/${BINDIR}/sahl --version WORKING_DIRECTORY ${prefix}
                OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT version STREQUAL "sahl ${VERSION}")
    message(FATAL_ERROR "the installed program says \"${version}\", not \"sahl ${VERSION}\"")
endif()
file(GLOB_RECURSE files RELATIVE ${prefix} ${prefix}/*)
if(NOT files STREQUAL "${BINDIR}/sahl")
    message(FATAL_ERROR "installed more or less than the program: ${files}")
endif()
file(REMOVE_RECURSE ${prefix})
