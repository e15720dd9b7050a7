// SPDX-License-Identifier: MIT
// The recursion (whitted.h) turned into waves: all rays of one depth of a tile together, level by level. What a step does
// is then done to many rays in a row, in lanes: nearest hits, surfaces, light, shadow rays by light. The mirrored and
// refracted rays of a level's hits are the next level; colours are summed up on the way back, in the recursion's order,
// so that every bit is the same. Whitted stays as the readable twin (tests/raytrace/test_wave.cpp), and for what waves do
// not do: explanations, light in double, faults on purpose, the cost of each pixel.
#pragma once

#include <array>
#include <vector>

#include "common/model/surface_batch.h"
#include "common/picture/frame.h"
#include "raytrace/clearings.h"
#include "raytrace/enclosed.h"
#include "raytrace/eye_packets.h"
#include "raytrace/kernels.h"
#include "raytrace/lone_hit.h"
#include "raytrace/media_sets.h"
#include "raytrace/secondary.h"
#include "raytrace/shadow_packets.h"

namespace sidelight::raytrace {

// Hits of one kind of primitive whose surfaces and light were found together, and the rays that leave there.
struct HitBatch {
  ObjectKind kind = ObjectKind::mesh;
  int size = 0;
  SurfaceBatch::Channel<std::uint32_t> ray, material;  // the ray's number in its level
  SurfaceBatch::Vectors from, normal, facing;          // leaving_point, N and Nv, where rays leave
  SurfaceBatch::Channel<double> clearance;             // Place::clearance, likewise
  SurfaceBatch::Channel<std::uint8_t> plain;     // rays leave straight above the point: no wall is in the way
  SurfaceBatch::Channel<std::uint8_t> entering;  // of balls: the ray came from outside
  LitBatch lit;
  ShadingBatch::Rgb light{}, missing{};  // sums of T_i, c1 left out: of lights that are seen, that are not
};

// A secondary ray: where it comes from, and how what it brings back is counted there. A wave has thousands of them, which
// stay in the cache if they are small.
struct WaveRay {
  Ray ray;
  double weight = 1;  // Path::weight
  glm::vec3 c{0};     // Share::c
  std::uint32_t parent = 0;
  MediaSets::Number media = 0;  // where it travels
  // The primitive where it starts, if its own next hit there is found beforehand (first_hit), else kNone.
  std::uint32_t own = kNone;
  RayKind kind = RayKind::mirrored;
  bool passes = false;  // at its start it crosses that primitive and no other, without a change of medium
};

// What is known of a hit that sends rays before their directions are found.
struct Sender {
  std::size_t entry = 0;  // of its batch
  Lone lone = Lone::unknown;
  bool solid = false;
  bool entering = false;         // of a solid that refracts: whether the ray does
  MediaSets::Number behind = 0;  // likewise
};

// Rays of one depth that are traced together. Numbers are those of the rays; of the eye's level, of the tile's samples
// in the order of EyePackets.
struct Level {
  int depth = 1;                 // Path::depth of the rays
  std::vector<WaveRay> rays;     // none at the eye's level: those are the camera's
  std::vector<WaveRay> waiting;  // rays of this depth whose turn comes later
  std::vector<Hit> hits;
  // Of the eye's level: nothing else stands near the hit, as far as EyePackets can tell; that is less than lone.
  std::vector<std::uint8_t> alone;
  // Of the others: what lone_hit() says of hits on solids, is_clear() of the rest.
  std::vector<Lone> lone;
  std::vector<glm::vec3> color, mirrored, refracted;  // the last two where there are secondary rays
  std::vector<double> cut;                            // likewise: weights not sent there, and below

  bool is_eye() const { return depth == 1; }
};

// Whether the ray comes from the outward side, Nv being `facing`: as locate() has it.
bool is_entering(const Scene& scene, const Ray& ray, const Hit& hit, const glm::dvec3& facing);

// One for each thread, for tile after tile of one picture.
class Wave {
 public:
  // The picture's threads share `clearings`.
  Wave(const Prepared& prepared, const Camera& camera, const Media& eye_media, const RenderOptions& options,
       Clearings& clearings);

  // Traces the samples of these pixels.
  void trace(const Rect& pixels, RenderStats& stats);
  // Then: their means into the frame; the sums of their samples' cut weights into `cut`, which is
  // as large as the frame where there are secondary rays.
  void write(Frame& frame, std::vector<double>& cut);

 private:
  using Colors = std::vector<glm::vec3>;

  std::size_t columns() const { return static_cast<std::size_t>(camera_.n * pixels_.width()); }
  std::size_t samples() const { return columns() * static_cast<std::size_t>(camera_.n * pixels_.height()); }
  Ray ray_of(const Level& level, std::size_t ray) const;
  MediaSets::Number media_of(const Level& level, std::size_t ray) const;
  double weight_of(const Level& level, std::size_t ray) const;
  Hit start_of(const WaveRay& ray, const Level& parent) const;

  void begin(const Rect& pixels);
  void take_primary(std::vector<Hit>& hits) const;
  void trace_level(std::size_t depth);
  bool take_part(std::size_t depth);
  void forget_media();
  void find_hits(Level& level);
  void find_first_hits(Level& level);
  void find_own_hits(Level& level);
  void take_own_hits(Level& level);
  Hit first_shaded(Hit hit, WaveRay& ray, Lone& lone);
  void find_surfaces(Level& level);
  void find_seen_surfaces(Level& level);
  std::size_t add_seen(const Level& level, std::size_t first, const Object& object);
  void flush(Level& level, SurfaceBatch& batch);
  void find_leaving_points(Level& level, const SurfaceBatch& surfaces, HitBatch& batch);
  bool stands_alone(Level& level, std::size_t ray, ObjectKind kind);
  bool enters_ball(const Level& level, std::size_t ray, const glm::dvec3& facing) const;
  void add_lights(const Level& level);
  void find_shadows(std::size_t light);
  void find_queries(const Level& level);
  void find_asking(std::size_t light);
  void add_lights_of(HitBatch& batch) const;
  void sum_up(Level& level);
  void send_secondary(Level& level, Level& next);
  void find_senders(Level& level, const HitBatch& batch);
  void find_behind(const Level& level, const HitBatch& batch, const Ray& ray, Sender& sender);
  bool is_total(std::size_t k) const {  // reflection at entry k of optics_
    return optics_.eta[k] != OpticsBatch::kNoRefraction && optics_.total[k] != 0;
  }
  WaveRay* send(Level& level, std::uint32_t parent, const Share& share, RayKind kind, Level& next);
  void send_mirrored(Level& level, const HitBatch& batch, std::size_t k, Level& next);
  void send_transmitted(Level& level, const HitBatch& batch, std::size_t k, Level& next);
  template <class T>
  const std::vector<T>& in_rows(const std::vector<T>& of, std::vector<T>& rows) const;
  void bring_back(const Level& level, Level& parent) const;
  HitBatch& next_batch();

  RenderStats* stats_ = nullptr;  // of trace()
  const Prepared& prepared_;
  const Scene& scene_;
  const Camera& camera_;
  Isa isa_;
  const Frame* primary_;      // RenderOptions::primary
  bool secondary_, shadows_;  // whether there are such rays
  bool want_parts_, want_shadow_, want_normal_, want_t_;
  Rect pixels_;
  std::vector<Shares> shares_;  // of each material
  MediaSets media_;             // the first: around the eye
  // The tile's samples as EyePackets has them: the number of each, counted row by row, its column and its row; and the
  // place of each number in this order.
  std::vector<std::uint32_t> order_, place_;
  std::vector<double> column_, row_;
  EyePackets eye_packets_;
  double farthest_alone_ = 0;  // depth up to which Level::alone holds
  ShadowPackets shadow_packets_;
  Enclosures enclosures_;
  Clearings& clearings_;
  ShadowQueries queries_;  // of entry i of batch b: [b kCapacity + i]
  // Likewise: the solid around it, or kNone; empty where there surely is none.
  std::vector<std::uint32_t> enclosing_;
  std::vector<RayQuestion> questions_;
  std::vector<std::uint32_t> asking_;  // which are the rays of questions_
  std::vector<std::uint8_t> dark_;
  std::vector<Level> levels_;
  std::array<SurfaceBatch, 3> surfaces_;  // by ObjectKind
  ShadingBatch shading_;
  OpticsBatch optics_;
  BallBatch balls_;
  std::array<Sender, OpticsBatch::kCapacity> senders_;  // entry by entry
  std::vector<HitBatch> batches_;  // of the level that is worked at, the first used_ of them
  std::size_t used_ = 0;
  // Of the eye's level, where they are wanted.
  std::array<Colors, 3> parts_;  // ambient, diffuse, specular
  Colors shadow_, normal_;
  std::vector<double> t_;
  // What is about to be written, row by row.
  Colors rows_, normal_rows_;
  std::vector<double> t_rows_;
};

}  // namespace sidelight::raytrace
