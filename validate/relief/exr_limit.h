#pragma once

namespace gnomon {

/// The largest side of an EXR that is read, pixels.
constexpr int largestExrSide = 1 << 20;

/// Has OpenEXR refuse images with a larger side, for this process. Without a limit it takes memory
/// for an index of all lines that a header promises, gigabytes for a damaged one of some bytes,
/// before anybody can ask for the size. To be called before an EXR is opened; cheap.
void limitExrSize();

}  // namespace gnomon
