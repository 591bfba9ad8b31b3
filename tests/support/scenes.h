// Scene files for tests of the command line.
#pragma once

#include <string>

#include "support/temp_folder.h"

namespace unshot::testing_support {

inline const std::string kMaterials =
    "newmtl white\nKd 0.7 0.7 0.7\n"
    "newmtl light\nKd 0.5 0.5 0.5\nKe 3 3 3\n"
    "newmtl bright\nKd 1.5 0.5 0.5\n";

/// A closed room of 1 m with a ceiling that shines: 8 vertices, 6 faces, lines 1 to 17. Nothing in it can
/// occlude.
inline std::string roomObj(const std::string& wall = "white", const std::string& ceiling = "light") {
  return "mtllib room.mtl\n"
         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "usemtl " +
         wall +
         "\n"
         "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 1 4 8 5\n"
         "usemtl " +
         ceiling + "\nf 4 3 7 8\n";
}

/// Lines that make a small box in the room, which occludes: the next vertices are 9 to 16.
inline std::string boxObj() {
  return "usemtl white\n"
         "v 0.3 0 0.3\nv 0.6 0 0.3\nv 0.6 0.4 0.3\nv 0.3 0.4 0.3\n"
         "v 0.3 0 0.6\nv 0.6 0 0.6\nv 0.6 0.4 0.6\nv 0.3 0.4 0.6\n"
         "f 9 12 11 10\nf 13 14 15 16\nf 9 13 16 12\nf 10 11 15 14\nf 12 16 15 11\n";
}

/// Writes room.mtl and room.obj with `more` lines at its end; returns the scene's path.
inline std::string writeRoom(const TempFolder& folder, const std::string& more = {}) {
  folder.write("room.mtl", kMaterials);
  return folder.write("room.obj", roomObj() + more);
}

}  // namespace unshot::testing_support
