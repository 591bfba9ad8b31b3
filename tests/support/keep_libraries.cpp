// Linked into the program where AddressSanitizer is on: libraries opened at run time stay loaded to the end.
//
// With a window, GLFW unloads libGL and its drivers before leaks are looked for. What they keep then has no
// name any more, and leak_suppressions.txt, which goes by the names of libraries, cannot tell it from the
// program's own.
extern "C" int dlclose(void*) noexcept { return 0; }
