// SPDX-License-Identifier: MIT
// PNG and EXR to planes of floats and ids, for picture_codec.h. Pixels are read in the file's own types and decoded here,
// since OpenImageIO treats integers as normalised wherever it converts.
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <cstring>
#include <memory>
#include <new>

#include "common/picture/picture_codec.h"

namespace sidelight {
namespace {

std::unique_ptr<OIIO::ImageInput> open_picture(const std::string& path, PictureFormat format,
                                               OIIO::ImageSpec& spec) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // leave colours as they are in the file
  // By what the file is, not by its name: no other reader may guess at a hostile file.
  auto input = OIIO::ImageInput::create(format == PictureFormat::png ? "png" : "openexr");
  if (!input) reject_file(path, "no reader for this format: " + OIIO::geterror());
  if (!input->open(path, spec, config)) reject_file(path, "not a readable picture: " + input->geterror());
  return input;
}

// One channel of interleaved pixels in the file's own types.
struct Plane {
  const std::byte* first;
  std::size_t stride, count;

  template <class T>
  T at(std::size_t i) const {
    T value;
    std::memcpy(&value, first + i * stride, sizeof value);
    return value;
  }
};

std::vector<std::uint32_t> id_values(const Plane& plane) {
  std::vector<std::uint32_t> values(plane.count);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = plane.at<std::uint32_t>(i);
  return values;
}

// `srgb`: integer values are sRGB codes, not linear.
std::vector<float> float_values(const Plane& plane, OIIO::TypeDesc type, bool srgb, const std::string& path) {
  std::vector<float> values(plane.count);
  const auto fill = [&](auto decode) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = decode(i);
  };
  if (type == OIIO::TypeFloat) {
    fill([&](std::size_t i) { return plane.at<float>(i); });
  } else if (type == OIIO::TypeHalf) {
    const auto stride = static_cast<OIIO::stride_t>(plane.stride);
    OIIO::convert_image(1, static_cast<int>(plane.count), 1, 1, plane.first, type, stride, OIIO::AutoStride,
                        OIIO::AutoStride, values.data(), OIIO::TypeFloat, sizeof(float), OIIO::AutoStride,
                        OIIO::AutoStride);
  } else if (type == OIIO::TypeUInt8 && srgb) {
    fill([&](std::size_t i) { return decode_srgb8(plane.at<std::uint8_t>(i)); });
  } else if (type == OIIO::TypeUInt8) {
    fill([&](std::size_t i) { return static_cast<float>(plane.at<std::uint8_t>(i) / 255.0); });
  } else if (type == OIIO::TypeUInt16) {
    fill([&](std::size_t i) {
      const double value = plane.at<std::uint16_t>(i) / 65535.0;
      return srgb ? decode_srgb(value) : static_cast<float>(value);
    });
  } else {
    reject_file(path, std::string("a channel of type ") + type.c_str() +
                          "; expected float, half, uint or a PNG's integers");
  }
  return values;
}

void read_channels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, bool linear, const std::string& path,
                   ImageFile& image) {
  std::vector<std::byte> pixels(spec.image_bytes(true));
  if (!input.read_image(0, 0, 0, -1, OIIO::TypeUnknown, pixels.data())) {
    reject_file(path, "the pixels cannot be read: " + input.geterror());
  }
  std::size_t offset = 0;
  for (int c = 0; c < spec.nchannels; ++c) {
    const OIIO::TypeDesc type = spec.channelformat(c);
    const std::string name(spec.channel_name(c));
    const Plane plane{pixels.data() + offset, spec.pixel_bytes(true), spec.image_pixels()};
    const bool srgb = !linear && name != "A";
    if (type == OIIO::TypeUInt32) {
      image.ids[name] = id_values(plane);
    } else {
      image.channels[name] = float_values(plane, type, srgb, path);
    }
    offset += type.size();
  }
}

void read_metadata(const OIIO::ImageSpec& spec, ImageFile& image) {
  const std::string prefix = "sidelight:";
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    const std::string name(attribute.name());
    if (!name.starts_with(prefix)) continue;
    image.metadata[name.substr(prefix.size())] = attribute.get_string();
  }
}

// A grey file's one channel is each of the three colours.
void require_colors(ImageFile& image, const std::string& path) {
  const bool has_color =
      image.channels.contains("R") || image.channels.contains("G") || image.channels.contains("B");
  // OpenEXR's other way to say colours; its Y alone would pass for a grey picture.
  if (!has_color && (image.channels.contains("RY") || image.channels.contains("BY")))
    reject_file(path, "luminance and chroma (Y, RY, BY); expected R, G and B");
  if (!has_color && image.channels.contains("Y")) {
    for (const char* color : {"R", "G", "B"}) image.channels[color] = image.channels["Y"];
    image.channels.erase("Y");
  }
  for (const char* color : {"R", "G", "B"}) {
    if (image.ids.contains(color))
      reject_file(path, std::string("channel ") + color + " is of type uint; expected float or half");
    if (!image.channels.contains(color))
      reject_file(path, std::string("no channel ") + color + "; expected R, G and B");
  }
}

}  // namespace

ImageFile read_claimed(const std::string& path, const PictureClaim& claim) {
  OIIO::ImageSpec spec;
  const auto input = open_picture(path, claim.format, spec);
  // A tiled EXR may claim more than its picture (whole tiles), never less.
  if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.width > claim.width ||
      spec.height > claim.height) {
    reject_file(path, "the size of the picture is contradictory");
  }
  ImageFile image;
  image.width = image.full_width = spec.width;
  image.height = image.full_height = spec.height;
  if (claim.format == PictureFormat::openexr) {
    image.x0 = spec.x - spec.full_x;
    image.y0 = spec.y - spec.full_y;
    image.full_width = spec.full_width;
    image.full_height = spec.full_height;
  }
  image.png = claim.format == PictureFormat::png;
  read_metadata(spec, image);
  const bool linear = claim.format == PictureFormat::openexr ||
                      spec["sidelight:encoding"].get() == "linear" ||
                      OIIO::Strutil::iequals(spec["oiio:ColorSpace"].get(), "linear");  // also by a gAMA of 1
  read_channels(*input, spec, linear, path, image);
  require_colors(image, path);
  return image;
}

}  // namespace sidelight

// What the library hands out, of this file and of image_write.cpp.
extern "C" __attribute__((visibility("default"))) const sidelight::PictureCodec* sidelight_picture_codec() {
  static constexpr sidelight::PictureCodec kCodec{sidelight::png_bytes, sidelight::png_linear16_bytes,
                                                  sidelight::exr_bytes, sidelight::read_claimed};
  return &kCodec;
}
