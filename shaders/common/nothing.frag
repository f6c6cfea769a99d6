// Depth or stencil alone.

void main() {}
