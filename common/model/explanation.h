// SPDX-License-Identifier: MIT
// Why a sample has its colour: plain records that the renderers' own code fills when it is given a recorder. A
// recorder is a template parameter (raytrace/recorder.h, raster/tile.h): that of a picture hears nothing and costs nothing.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/model/surface.h"

namespace sidelight {

// Of phong.h and shading.h, which bring lanes with them: whoever only reads records, as the window does, need not.
template <class F>
struct LightTerm;
template <class T>
struct ShadingTablesOf;

// What one light adds to a surface: T = diffuse + specular, counted where `seen`.
struct LightRecord {
  std::size_t light = 0;
  float cosine = 0, highlight = 0, arriving = 0;  // N.L, (Rl.V)^s, f(d)
  glm::vec3 diffuse{0}, specular{0};              // c1 not included
  bool seen = true;                               // b_i
  bool self_shadowed = false;                     // not seen, since the surface stands in its own light
  std::uint32_t blocker = kNone;                  // primitive that stands in between, where one was met
};

// Local light at a surface: c1 (ambient + sum of T over the lights that are seen).
struct LocalRecord {
  Hit hit;
  Surface surface;
  glm::vec3 local{0}, ambient{0};  // c1, ka Ia
  std::vector<LightRecord> lights;
};

// ---- The z-buffer: what competed for a sample ----

struct FragmentRecord {
  Hit hit;
  bool kept = false;  // nearer than all that were drawn before it
};

struct RasterRecord {
  std::vector<FragmentRecord> fragments;  // in drawing order
  bool background = true;
  LocalRecord local;   // unless background
  glm::vec3 color{0};  // of the sample
};

// ---- The tracer: the tree of rays ----

enum class RayKind { eye, mirrored, refracted, internally_reflected, straight };

struct RayRecord {
  RayKind kind = RayKind::eye;
  glm::dvec3 origin{0}, direction{0};
  int depth = 1;
  double path_weight = 1;
  // How the parent counts it: c w(r) color. 1 for the eye ray.
  glm::vec3 coefficient{1};
  float falloff = 1;
  bool sent = true;         // false: too deep or too light, and black
  std::vector<Hit> passed;  // surfaces inside one medium, passed without colour
  bool background = true;   // it met nothing
  LocalRecord local;        // unless background
  glm::vec3 color{0};       // what it brings back
  std::vector<RayRecord> children;
};

// Every number that the ray adds to its root: background, ambient, diffuse and specular terms, each times all that it
// was weighed by on the way, in double. Their sum is the root's colour up to the rounding of its floats.
std::vector<glm::dvec3> leaves(const RayRecord& root);

LightRecord record_light(std::size_t light, const LightTerm<float>& term);

// Local light with every light seen, term by term: the scalar twin of what shade() computes, and so its bits.
LocalRecord record_local(const Scene& scene, const ShadingTablesOf<float>& tables, const Ray& ray,
                         const Hit& hit, VisibilityCounts& counts);

}  // namespace sidelight
