// Both answers for every pixel. Bit 0, `test`: the method's shadow test says shadowed. Bit 1, `drawn`:
// the point is dark in the method's picture, by that test or because it is turned from the light. Bit
// 3: it met a texel of another chart. From bit 4 on: what is no answer (answers.glsl).

layout(location = 0) out uint answers;

void main() {
  Pixel pixel = makePixel();
  bool isTurned = isTurnedAway(pixel);
  bool isHidden = isShadowed(pixel, makeLocalLight(pixel, lightDirection));
  checkNormal(pixel);
  answers = (isHidden ? 1u : 0u) | (isHidden || isTurned ? 2u : 0u) | (hasMetOtherChart ? 8u : 0u) |
            answerFaults << 4;
}
