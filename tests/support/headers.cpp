// Nothing but a target to compile the headers for that the tests share (tests/CMakeLists.txt).
