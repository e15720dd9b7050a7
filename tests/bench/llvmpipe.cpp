// SPDX-License-Identifier: MIT
#include "tests/bench/llvmpipe.h"

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/llvmpipe_gl.h"

namespace sidelight::bench {
namespace {

const char* const kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform vec3 eye;
uniform mat4 clip_from_eye;
out vec3 from_eye, surface_normal;
void main() {
  from_eye = position - eye;
  surface_normal = normal;
  gl_Position = clip_from_eye * vec4(from_eye, 1);
})";

const char* const kPhongShader = R"(#version 330 core
in vec3 from_eye, surface_normal;
uniform vec3 light_from_eye[2], intensity[2];
uniform vec3 ambient, diffuse, specular;
uniform float shininess;
out vec4 color;
void main() {
  vec3 n = normalize(gl_FrontFacing ? surface_normal : -surface_normal);
  vec3 to_viewer = -normalize(from_eye);
  vec3 sum = ambient;
  for (int i = 0; i < 2; ++i) {
    vec3 to_light = normalize(light_from_eye[i] - from_eye);
    float cosine = dot(n, to_light);
    if (cosine > 0.0) {
      float highlight = max(dot(2.0 * cosine * n - to_light, to_viewer), 0.0);
      sum += intensity[i] * (cosine * diffuse + pow(highlight, shininess) * specular);
    }
  }
  color = vec4(sum, 1);
})";

const char* const kIdShader = R"(#version 330 core
uniform uint first;
out uint id;
void main() { id = first + uint(gl_PrimitiveID) + 1u; })";

// Of the depth range, in scene units: all that the scenes' cameras see lies between.
constexpr double kNear = 0.25, kFar = 64;

struct Vertex {
  glm::vec3 position, normal;
};

std::vector<Vertex> vertices_of(const Scene& scene) {
  std::vector<Vertex> vertices;
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    vertices.push_back({scene.positions[i], scene.normals.at(i)});
  return vertices;
}

std::vector<std::uint32_t> indices_of(const Scene& scene) {
  std::vector<std::uint32_t> indices;
  for (const Triangle& triangle : scene.triangles) {
    if (triangle.vertex != triangle.normal)
      throw std::logic_error("a normal and its position have two numbers");
    indices.insert(indices.end(), triangle.vertex.begin(), triangle.vertex.end());
  }
  return indices;
}

// Column by column, as OpenGL reads it: x_clip = 2H/W (p.r) / |r|^2 and so on (camera.h), w_clip = p.f.
std::array<float, 16> clip_from_eye(const Camera& camera) {
  const glm::dvec3 x = 2.0 * camera.height / camera.width / dot(camera.right, camera.right) * camera.right;
  const glm::dvec3 y = 2.0 / dot(camera.up, camera.up) * camera.up;
  const glm::dvec3 z = (kFar + kNear) / (kFar - kNear) * camera.forward;
  std::array<float, 16> m{};
  for (int column = 0; column < 3; ++column) {
    const std::array<double, 4> entries{x[column], y[column], z[column], camera.forward[column]};
    for (std::size_t row = 0; row < 4; ++row)
      m[4 * static_cast<std::size_t>(column) + row] = float(entries[row]);
  }
  m[14] = static_cast<float>(-2 * kFar * kNear / (kFar - kNear));
  return m;
}

}  // namespace

struct Llvmpipe::State {
  State(const Scene& s, int threads)
      : scene(s),
        current(threads),
        gl(load_bench_gl()),
        array(make_vertex_array(gl)),
        vertices(make_buffer(gl)),
        indices(make_buffer(gl)),
        phong(make_program(gl, kVertexShader, kPhongShader)),
        ids(make_program(gl, kVertexShader, kIdShader)) {}

  const Scene& scene;
  LlvmpipeContext current;
  BenchGl gl;
  GlObject array, vertices, indices, phong, ids;
  std::vector<GlObject> buffers;  // of the size
  GLuint phong_target = 0, id_target = 0;
  int width = 0, height = 0;

  GLint place(const GlObject& program, const std::string& name) const {
    return gl.GetUniformLocation(program.name(), name.c_str());
  }
  void set(const GlObject& program, const std::string& name, const glm::dvec3& value) const {
    const glm::vec3 v(value);
    gl.Uniform3fv(place(program, name), 1, &v.x);
  }

  void upload() {
    const std::vector<Vertex> v = vertices_of(scene);
    const std::vector<std::uint32_t> i = indices_of(scene);
    gl.BindVertexArray(array.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(v.size() * sizeof(Vertex)), v.data(),
                  GL_STATIC_DRAW);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(i.size() * 4), i.data(), GL_STATIC_DRAW);
    for (GLuint attribute = 0; attribute < 2; ++attribute) {
      gl.EnableVertexAttribArray(attribute);
      gl.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                             reinterpret_cast<const void*>(attribute * sizeof(glm::vec3)));
    }
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.Disable(GL_DITHER);
  }

  GLuint renderbuffer(GLenum format) {
    GLuint name = 0;
    gl.GenRenderbuffers(1, &name);
    buffers.emplace_back(gl, name, [](const Gl& table, GLuint old) {
      static_cast<const BenchGl&>(table).DeleteRenderbuffers(1, &old);
    });
    gl.BindRenderbuffer(GL_RENDERBUFFER, name);
    gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    return name;
  }
  GLuint target(GLenum format, GLuint depth) {
    GLuint name = 0;
    gl.GenFramebuffers(1, &name);
    buffers.emplace_back(gl, name, [](const Gl& table, GLuint old) {
      static_cast<const BenchGl&>(table).DeleteFramebuffers(1, &old);
    });
    gl.BindFramebuffer(GL_FRAMEBUFFER, name);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer(format));
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error("OpenGL has no framebuffer of this kind");
    return name;
  }

  void set_lights(const Camera& camera) const {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string index = "[" + std::to_string(i) + "]";
      set(phong, "light_from_eye" + index, scene.lights.at(i).position - camera.eye);
      set(phong, "intensity" + index, scene.lights[i].intensity);
    }
  }
  void set_material(const Material& material) const {
    set(phong, "ambient", material.ambient * scene.ambient);
    set(phong, "diffuse", material.diffuse);
    set(phong, "specular", material.specular);
    gl.Uniform1f(place(phong, "shininess"), static_cast<float>(material.shininess));
  }

  // All objects into the target, colours or ids, and waits until they are there.
  void draw(const Camera& camera, bool colors) {
    const GlObject& program = colors ? phong : ids;
    gl.BindFramebuffer(GL_FRAMEBUFFER, colors ? phong_target : id_target);
    const glm::vec4 background(glm::vec3(scene.background), 1), farthest(1);
    const std::array<GLuint, 4> nothing{};
    if (colors)
      gl.ClearBufferfv(GL_COLOR, 0, &background.x);
    else
      gl.ClearBufferuiv(GL_COLOR, 0, nothing.data());
    gl.ClearBufferfv(GL_DEPTH, 0, &farthest.x);
    gl.UseProgram(program.name());
    set(program, "eye", camera.eye);
    gl.UniformMatrix4fv(place(program, "clip_from_eye"), 1, GL_FALSE, clip_from_eye(camera).data());
    if (colors) set_lights(camera);
    for (const Object& object : scene.objects) {
      if (colors)
        set_material(scene.materials[scene.triangles[object.first].material]);
      else
        gl.Uniform1ui(place(program, "first"), object.first);
      gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * object.count), GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(12 * std::size_t{object.first}));
    }
    gl.Finish();
  }

  template <class T>
  std::vector<T> read(GLenum format, GLenum type) const {
    std::vector<T> rows(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    gl.ReadPixels(0, 0, width, height, format, type, rows.data());
    std::vector<T> out;
    for (int y = height - 1; y >= 0; --y)  // OpenGL's first row is the lowest
      out.insert(out.end(), rows.begin() + std::ptrdiff_t{y} * width,
                 rows.begin() + std::ptrdiff_t{y + 1} * width);
    return out;
  }
};

Llvmpipe::Llvmpipe(const Scene& scene, int threads) : state_(std::make_unique<State>(scene, threads)) {
  const std::string name = reinterpret_cast<const char*>(state_->gl.GetString(GL_RENDERER));
  if (!name.starts_with("llvmpipe"))
    throw std::runtime_error("the OpenGL of OSMesa is not llvmpipe but " + name);
  state_->upload();
}
Llvmpipe::~Llvmpipe() = default;

void Llvmpipe::resize(int width, int height) {
  state_->buffers.clear();
  state_->width = width;
  state_->height = height;
  const GLuint depth = state_->renderbuffer(GL_DEPTH_COMPONENT32F);
  state_->phong_target = state_->target(GL_RGBA8, depth);
  state_->id_target = state_->target(GL_R32UI, depth);
  state_->gl.Viewport(0, 0, width, height);
}

void Llvmpipe::draw(const Camera& camera) { state_->draw(camera, true); }

Frame Llvmpipe::look(const Camera& camera) {
  RenderOptions options;
  options.layers = layer_bit(Layer::depth) | layer_bit(Layer::primitive);
  Frame frame = make_frame(camera.width, camera.height, 1, options);
  state_->draw(camera, true);
  const auto colors = state_->read<std::array<unsigned char, 4>>(GL_RGBA, GL_UNSIGNED_BYTE);
  state_->draw(camera, false);
  const auto ids = state_->read<std::uint32_t>(GL_RED_INTEGER, GL_UNSIGNED_INT);
  std::copy(ids.begin(), ids.end(), frame.primitive_id.begin());
  const auto depths = state_->read<float>(GL_DEPTH_COMPONENT, GL_FLOAT);
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    frame.color[i] = glm::vec3(colors[i][0], colors[i][1], colors[i][2]) / 255.0f;
    const double ndc = 2 * double{depths[i]} - 1;
    if (frame.primitive_id[i] != 0)
      frame.depth[i] = static_cast<float>(2 * kFar * kNear / ((kFar + kNear) - ndc * (kFar - kNear)));
  }
  return frame;
}

}  // namespace sidelight::bench
