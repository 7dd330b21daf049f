# From GLSL to SPIR-V: compile, validate, check every float instruction, decorate, validate again.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# sahl_spirv(output.spv SOURCE file.comp [RAW] [DEFINES A B ...]): RAW leaves out the last two steps
# (used by the canaries, which show that the steps are needed).
function(sahl_spirv output)
    cmake_parse_arguments(ARG "RAW" "SOURCE" "DEFINES" ${ARGN})
    set(defines ${ARG_DEFINES})
    list(TRANSFORM defines PREPEND -D)
    set(finish COMMAND sahl_shader_step exact ${output}.raw ${output}
               COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${output})
    if(ARG_RAW)
        set(finish COMMAND ${CMAKE_COMMAND} -E copy ${output}.raw ${output})
    endif()
    cmake_path(GET output FILENAME name)
    add_custom_command(OUTPUT ${output}
        COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.1 -g0 -I${SAHL_ROOT}/shaders
                ${defines} --depfile ${output}.d -o ${output}.raw ${ARG_SOURCE}
        COMMAND ${SPIRV_VAL} --target-env vulkan1.1 ${output}.raw
        ${finish}
        DEPENDS ${ARG_SOURCE} sahl_shader_step
        DEPFILE ${output}.d
        COMMENT "SPIR-V ${name}" VERBATIM)
endfunction()

# sahl_embed(output.cpp FUNCTION kernelSpirv MODULES name ...): C++ source with the modules name.spv of
# the current binary folder, behind std::span<const uint32_t> sahl::FUNCTION(std::string_view name).
function(sahl_embed output)
    cmake_parse_arguments(ARG "" "FUNCTION" "MODULES" ${ARGN})
    foreach(module ${ARG_MODULES})
        list(APPEND files ${CMAKE_CURRENT_BINARY_DIR}/${module}.spv)
        list(APPEND entries ${module}=${CMAKE_CURRENT_BINARY_DIR}/${module}.spv)
    endforeach()
    add_custom_command(OUTPUT ${output}
        COMMAND sahl_shader_step embed ${output} ${ARG_FUNCTION} ${entries}
        DEPENDS ${files} sahl_shader_step COMMENT "Embedding ${ARG_MODULES}" VERBATIM)
endfunction()
