# Writes OUTPUT: a C++ source that defines SYMBOL (namespace unshot), a std::span of the bytes of FILE.
file(READ "${FILE}" hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
file(WRITE "${OUTPUT}"
     "#include <span>\n\nnamespace unshot {\n\nstd::span<const unsigned char> ${SYMBOL}() {\n"
     "  static const unsigned char bytes[] = {\n${bytes}};\n  return bytes;\n}\n\n}  // namespace unshot\n")
