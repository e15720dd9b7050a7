// SPDX-License-Identifier: MIT
// PNG and EXR from frames, for picture_codec.h.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>

#include "common/error.h"
#include "common/picture/picture_codec.h"

namespace sidelight {
namespace {

// One channel of an EXR: where its first value stands in the frame, and how far it is to the next pixel's.
struct Channel {
  std::string name;
  OIIO::TypeDesc type;  // of 4 bytes: FLOAT or UINT
  const std::byte* first;
  std::size_t stride;
};
constexpr std::size_t kChannelBytes = 4;
static_assert(sizeof(glm::vec3) == 3 * kChannelBytes);

template <class T>
void add_channel(const KeptArray<T>& values, const std::string& name, OIIO::TypeDesc type,
                 std::vector<Channel>& channels) {
  static_assert(sizeof(T) == kChannelBytes);
  if (values.empty()) return;
  channels.push_back({name, type, reinterpret_cast<const std::byte*>(values.data()), sizeof(T)});
}

// `axes`: one letter per component, "RGB" or "XYZ".
void add_channels(std::span<const glm::vec3> values, const std::string& prefix, const std::string& axes,
                  std::vector<Channel>& channels) {
  if (values.empty()) return;
  const auto* first = reinterpret_cast<const std::byte*>(values.data());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    channels.push_back({prefix + axes[i], OIIO::TypeFloat, first + i * kChannelBytes, sizeof(glm::vec3)});
  }
}

std::vector<Channel> channels_of(const Frame& frame) {
  std::vector<Channel> channels;
  add_channels(frame.color, "", "RGB", channels);
  for (std::size_t i = 0; i < frame.rgb.size(); ++i) {
    add_channels(frame.rgb[i], std::string(kLayerNames[i]) + ".", "RGB", channels);
  }
  add_channel(frame.depth, "depth.Z", OIIO::TypeFloat, channels);
  add_channel(frame.object_id, "object.id", OIIO::TypeUInt32, channels);
  add_channel(frame.primitive_id, "primitive.id", OIIO::TypeUInt32, channels);
  add_channels(frame.normal, "normal.", "XYZ", channels);
  add_channel(frame.cost, "cost.tests", OIIO::TypeFloat, channels);
  return channels;
}

// Pixels [begin, end), channel by channel within a pixel: the layout that OpenImageIO takes without
// converting. (Whatever it converts, it treats integers as fractions of their maximum: an id of 7 would
// become 1.6e-9.)
std::vector<std::byte> interleaved(const std::vector<Channel>& channels, std::size_t begin, std::size_t end) {
  std::vector<std::byte> packed((end - begin) * channels.size() * kChannelBytes);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::byte* to = packed.data() + c * kChannelBytes;
    for (std::size_t i = begin; i < end; ++i, to += channels.size() * kChannelBytes) {
      std::memcpy(to, channels[c].first + i * channels[c].stride, kChannelBytes);
    }
  }
  return packed;
}

void set_metadata(const Metadata& metadata, OIIO::ImageSpec& spec) {
  spec.attribute("DateTime", "2004:01:01 00:00:00");  // else the time of writing: no two files alike
  for (const auto& [name, value] : metadata) {
    if (!value.empty())
      spec.attribute("sidelight:" + name, value);  // EXR would lose an empty one, PNG would not
  }
}

// The file's bytes; write_pixels(output) returns false on failure. `format`: "png", "openexr"; `name` is the picture's
// in the message.
template <class WritePixels>
std::vector<std::uint8_t> encode(const std::string& name, const char* format, const OIIO::ImageSpec& spec,
                                 WritePixels write_pixels) {
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  const bool ok = output && output->set_ioproxy(&memory) &&
                  output->open(std::string("memory.") + format, spec) && write_pixels(*output) &&
                  output->close();
  if (!ok) {
    const std::string reason = output ? output->geterror() : OIIO::geterror();
    throw OutputError(printable(name, 1000) + ": cannot encode as " + format + ": " +
                      printable(reason, 1000));
  }
  return bytes;
}

std::uint16_t quantised16(float linear) {
  if (!(linear > 0)) return 0;  // NaN too
  return static_cast<std::uint16_t>(std::floor(65535 * double{std::min(linear, 1.0f)} + 0.5));
}

}  // namespace

std::vector<std::uint8_t> png_bytes(const std::string& name, const Image8& image, const Metadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeUInt8);
  assert(image.rgb.size() == spec.image_bytes());
  spec.attribute("oiio:ColorSpace", "sRGB");
  set_metadata(metadata, spec);
  return encode(name, "png", spec, [&](OIIO::ImageOutput& output) {
    return output.write_image(OIIO::TypeUInt8, image.rgb.data());
  });
}

std::vector<std::uint8_t> png_linear16_bytes(const std::string& name, const Frame& frame,
                                             const Metadata& metadata) {
  OIIO::ImageSpec spec(frame.width(), frame.height(), 3, OIIO::TypeUInt16);
  spec.attribute("oiio:ColorSpace", "Linear");
  set_metadata(metadata, spec);
  set_metadata({{"encoding", "linear"}}, spec);
  std::vector<std::uint16_t> values;
  values.reserve(3 * frame.color.size());
  for (const glm::vec3& color : frame.color) {
    for (const float channel : {color.x, color.y, color.z}) values.push_back(quantised16(channel));
  }
  return encode(name, "png", spec, [&](OIIO::ImageOutput& output) {
    return output.write_image(OIIO::TypeUInt16, values.data());
  });
}

std::vector<std::uint8_t> exr_bytes(const std::string& name, const Frame& frame, const Metadata& metadata) {
  const std::vector<Channel> channels = channels_of(frame);
  OIIO::ImageSpec spec(frame.width(), frame.height(), static_cast<int>(channels.size()), OIIO::TypeFloat);
  spec.x = frame.window.x0;
  spec.y = frame.window.y0;
  spec.full_x = spec.full_y = 0;
  spec.full_width = frame.full_width;
  spec.full_height = frame.full_height;
  spec.channelnames.clear();
  for (const Channel& channel : channels) {
    spec.channelnames.push_back(channel.name);
    spec.channelformats.push_back(channel.type);
  }
  spec.attribute("compression", "zip");
  set_metadata(metadata, spec);

  // A multiple of the 16 rows that zip compresses together, and few enough that the packed copy stays small.
  constexpr int kRows = 64;
  const auto write_rows = [&](OIIO::ImageOutput& output) {
    for (int y = frame.window.y0; y < frame.window.y1; y += kRows) {
      const int y_end = std::min(y + kRows, frame.window.y1);
      const std::size_t begin = frame.index(frame.window.x0, y);
      const std::size_t end = frame.index(frame.window.x0, y_end);
      const std::vector<std::byte> packed = interleaved(channels, begin, end);
      if (!output.write_scanlines(y, y_end, 0, OIIO::TypeUnknown, packed.data())) return false;
    }
    return true;
  };
  return encode(name, "openexr", spec, write_rows);
}

}  // namespace sidelight
