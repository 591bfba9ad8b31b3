# Turns every file of a folder into one C++ source that defines the table declared in core/gl/shaders.h.
# The source is written at build time, again whenever a shader changes.
function(unshot_embed_shaders folder output)
  file(GLOB shader_files CONFIGURE_DEPENDS ${folder}/*.glsl ${folder}/*.vert ${folder}/*.frag ${folder}/*.comp
                                           ${folder}/*.geom)
  list(SORT shader_files)
  string(REPLACE ";" "|" shader_list "${shader_files}")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${shader_list}" -DOUTPUT=${output}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteShaderTable.cmake
    DEPENDS ${shader_files} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteShaderTable.cmake
    COMMENT "Embedding shaders"
    VERBATIM)
endfunction()
