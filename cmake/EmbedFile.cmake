# Turns a file into a C++ source that defines `std::span<const unsigned char> unshot::SYMBOL()`, written at build time.
function(unshot_embed_file file symbol output)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFILE=${file} -DSYMBOL=${symbol} -DOUTPUT=${output}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteBytes.cmake
    DEPENDS ${file} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteBytes.cmake
    COMMENT "Embedding ${file}"
    VERBATIM)
endfunction()
