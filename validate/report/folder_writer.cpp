#include "report/folder_writer.h"

#include <utility>

#include "image/channel_image.h"
#include "image/images.h"
#include "image/share_picture.h"
#include "image/web_picture.h"
#include "report/pictures/displaced_image.h"
#include "report/pictures/region_image.h"

namespace gnomon::report {

std::string FolderWriter::mask(const Mask& mask) const {
  return image::pngOf(image::maskImage(mask));
}

std::string FolderWriter::shares(const Visibility& map) const {
  return image::sharePng(map);
}

std::string FolderWriter::regions(const truth::Truth& truth) const {
  return image::pngOf(regionImage(truth));
}

std::string FolderWriter::weights(int width, int height, const std::vector<double>& weights) const {
  image::ChannelImage image{width, height, {"area"}, {}};
  image.values.reserve(weights.size());
  for (const double weight : weights) image.values.push_back(static_cast<float>(weight));
  return image::exrBytes(image);
}

std::string FolderWriter::picture(int width, int height, std::vector<std::uint8_t> rgb) const {
  return image::pngOf(image::Image{width, height, std::move(rgb)});
}

std::string FolderWriter::difference(const Mask& candidate, const Mask& truth) const {
  return image::pngOf(image::differenceImage(candidate, truth));
}

std::string FolderWriter::difference(const Visibility& candidate, const Visibility& truth) const {
  return image::pngOf(image::shareDifferenceImage(candidate, truth));
}

std::string FolderWriter::embedded(int width, int height, std::vector<std::uint8_t> rgb,
                                   study::EmbeddedSize size) const {
  const image::Image image{width, height, std::move(rgb)};
  return size == study::EmbeddedSize::small
             ? image::webPicture(image, image::smallQuality, image::smallSide)
             : image::webPicture(image, image::fineQuality);
}

std::vector<std::uint8_t> FolderWriter::displaced(int width, int height,
                                                  const std::vector<float>& light) const {
  return displacedImage(width, height, light).rgb;
}

void FolderWriter::beQuiet() {
  if (quiet_) quiet_();
}

void FolderWriter::write(const std::string& path, const std::string& bytes) {
  folder_.write(path, bytes);
}

}  // namespace gnomon::report
