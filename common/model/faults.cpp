// SPDX-License-Identifier: MIT
#include "common/model/faults.h"

#include <charconv>

namespace sidelight {
namespace {

std::string number(double value) {
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6).ptr;
  return {buffer.data(), end};
}

std::string setting(const Faults& faults, FaultKind fault) {
  switch (fault) {
    case FaultKind::shadow_offset:
      return number(*faults.shadow_offset);
    case FaultKind::depth_format:
      return std::string(kDepthFormatNames[static_cast<std::size_t>(*faults.depth_format)]) + " from " +
             number(faults.near_plane) + " to " + number(faults.far_plane);
    case FaultKind::snap_bits:
      return std::to_string(*faults.snap_bits);
    case FaultKind::tessellate:
      return std::to_string(*faults.tessellate);
    case FaultKind::precision:
      break;
  }
  return "float";
}

}  // namespace

void Faults::set_usual_planes(double distance) {
  near_plane = 1e-3 * distance;
  far_plane = 1e3 * distance;
}

bool Faults::has(FaultKind fault) const {
  switch (fault) {
    case FaultKind::shadow_offset:
      return shadow_offset.has_value();
    case FaultKind::depth_format:
      return depth_format.has_value();
    case FaultKind::snap_bits:
      return snap_bits.has_value();
    case FaultKind::tessellate:
      return tessellate.has_value();
    case FaultKind::precision:
      break;
  }
  return float_precision;
}

bool Faults::any() const { return *this != Faults{}; }

Faults Faults::without(FaultKind fault) const {
  Faults others = *this;
  switch (fault) {
    case FaultKind::shadow_offset:
      others.shadow_offset.reset();
      break;
    case FaultKind::depth_format:
      others.depth_format.reset();
      others.near_plane = others.far_plane = 0;
      break;
    case FaultKind::snap_bits:
      others.snap_bits.reset();
      break;
    case FaultKind::tessellate:
      others.tessellate.reset();
      break;
    case FaultKind::precision:
      others.float_precision = false;
      break;
  }
  return others;
}

Faults Faults::only(FaultKind fault) const {
  Faults one = *this;
  for (int i = 0; i < kFaults; ++i)
    if (const auto other = static_cast<FaultKind>(i); other != fault) one = one.without(other);
  return one;
}

std::string Faults::text() const {
  std::string out;
  for (int i = 0; i < kFaults; ++i) {
    const auto fault = static_cast<FaultKind>(i);
    if (!has(fault)) continue;
    if (!out.empty()) out += ", ";
    out += std::string(fault_name(fault)) + ' ' + setting(*this, fault);
  }
  return out;
}

}  // namespace sidelight
