#pragma once

#include <string>

#include "image/channel_image.h"
#include "report/run_folder.h"

namespace gnomon::exporting {

/// The other forms of a map `samples/VIEW.exr`: `samples/VIEW.npy` (npy_file.h), and
/// `samples/VIEW_layers.exr`, whose channels all are X, Y or Z of a layer, since programs as
/// Blender read no others: face, s and t are `place.X`, `.Y`, `.Z`, and weight is `texel.Z`.
std::string npyName(const std::string& mapFile);
std::string layersName(const std::string& mapFile);

/// Writes a map in its three forms, each whole or not at all.
/// @param mapFile  its name, with .exr at the end
void writeSampleMap(report::RunFolder& folder, const std::string& mapFile, image::ChannelImage map);

}  // namespace gnomon::exporting
