#include "report/folder_writer.h"

#include "report/displaced_image.h"
#include "report/images.h"

namespace gnomon {

void FolderWriter::mask(const std::string& path, const Mask& mask) {
  writePng(folder_ / path, maskImage(mask));
}

void FolderWriter::shaded(const std::string& path, int width, int height,
                          const std::vector<std::uint8_t>& rgb) {
  writePng(folder_ / path, Image{width, height, rgb});
}

void FolderWriter::difference(const std::string& path, const Mask& candidate, const Mask& truth) {
  writePng(folder_ / path, differenceImage(candidate, truth));
}

void FolderWriter::displaced(const std::string& path, int width, int height,
                             const std::vector<float>& light) {
  writePng(folder_ / path, displacedImage(width, height, light));
}

}  // namespace gnomon
