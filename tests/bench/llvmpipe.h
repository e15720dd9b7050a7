// SPDX-License-Identifier: MIT
// The peer of the z-buffer: Mesa's llvmpipe through OSMesa, given all that it fairly needs. Positions and normals lie in
// one buffer, uploaded once; each object is one indexed draw; the depth test is LESS on a float buffer; nothing is
// blended, culled or multisampled; the light model of common/model/phong.h, without attenuation, is a fragment shader
// relative to the eye; the picture stays in its 8-bit framebuffer. One a process (Mesa reads the number of its threads
// once), used by one thread.
#pragma once

#include <memory>

#include "common/picture/frame.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"

namespace sidelight::bench {

class Llvmpipe {
 public:
  // `scene` must outlive this and be as raster_entries (scenes.h) makes them. Draws with `threads` threads beside the
  // calling one, or with that alone where it is 1. Throws std::runtime_error where OpenGL is not llvmpipe.
  Llvmpipe(const Scene& scene, int threads);
  ~Llvmpipe();

  // Before the first draw(), and for another size.
  void resize(int width, int height);
  // One frame, finished.
  void draw(const Camera& camera);
  // One more, and what it shows: colours, primitives and depths (distance along the viewing direction; 0 on
  // background) as a frame of one sample a pixel.
  Frame look(const Camera& camera);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sidelight::bench
