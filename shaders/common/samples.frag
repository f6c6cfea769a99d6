// The sample that a pixel stands for: its limit face and the parameters there.

layout(location = 0) out int sampleFace;
layout(location = 1) out vec2 sampleSt;

void main() {
  sampleFace = face;
  sampleSt = clamp(st, 0.0, 1.0);
}
