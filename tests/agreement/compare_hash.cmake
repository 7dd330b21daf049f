# cmake -DPROGRAM=... -DEXPECTED=film_hash.txt -P compare_hash.cmake
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${EXPECTED} expected LIMIT_COUNT 1)
if(NOT hash STREQUAL expected)
    message(FATAL_ERROR "the film's hash is ${hash}, not ${expected}.\n"
        "If every optimisation level and compiler agrees on the new one, the text was changed on "
        "purpose: put it into ${EXPECTED}. Otherwise a compiler computes something else.")
endif()
