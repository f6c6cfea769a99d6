#pragma once

#include <string>

#include "image/image.h"
#include "report/run_folder.h"

namespace gnomon::exporting {

/// The other forms of a map `samples/VIEW.exr`: `samples/VIEW.npy`, and
/// `samples/VIEW_layers.exr`, whose channels all are X, Y or Z of a layer, since programs as
/// Blender read no others: face, s and t are `place.X`, `.Y`, `.Z`, and weight is `texel.Z`.
std::string npyName(const std::string& mapFile);
std::string layersName(const std::string& mapFile);

/// Writes a map in its three forms, each whole or not at all.
/// @param mapFile  its name, with .exr at the end
void writeSampleMap(report::RunFolder& folder, const std::string& mapFile, image::ChannelImage map);

/// A picture as the bytes of a NumPy file (format 1.0): 32-bit little-endian floats of shape
/// (height, width, channels), row 0 at the top. Same numbers, same bytes.
std::string npyBytes(const image::ChannelImage& image);

}  // namespace gnomon::exporting
