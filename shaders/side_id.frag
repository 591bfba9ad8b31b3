#version 330 core
// Which side is seen: its index + 1, 0 for none.

flat in uint vertex_side;

out uint id;

void main() { id = vertex_side + 1u; }
