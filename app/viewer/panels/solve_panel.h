// Sections of the panel on the solve: how it iterates and when it stops, its mesh, and its figures.
#pragma once

namespace unshot {

class Viewer;

void solveSection(Viewer& viewer);
void meshSection(Viewer& viewer);
void figuresSection(Viewer& viewer);

}  // namespace unshot
