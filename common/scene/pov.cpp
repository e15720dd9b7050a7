// SPDX-License-Identifier: MIT
// How each term is said. A material becomes layers, one per term, since a POV-Ray pigment colours all of its layer's:
//
//   top      pigment 2 c1 kd, half transparent; phong, reflection      diffuse and specular light, mirror ray
//   middle   pigment 4 c1 ka Ia (2 where opaque), half transparent     ambient light
//   bottom   filter 4 c3; absent on opaque materials                   refracted ray
//
// A layer's light is scaled by its opacity and by what the layers above let through: the factors 2 and 4 undo that.
#include "common/scene/pov.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "common/model/solid.h"
#include "common/scene/camera.h"
#include "common/scene/pov_mesh.h"

namespace sidelight {
namespace {

using glm::dvec3;

// POV-Ray ignores hits nearer than 1e-4, shadows nearer than 1e-3 and whatever is beyond 1e7, in its units. The scene
// is written with this extent, by a power of two, so that no coordinate is rounded.
constexpr double kExtent = 1024;
// Where a highlight's tint lacks a channel, this much of it stays: the pigment is divided by the tint.
constexpr double kLeastTint = 1e-6;

std::string rgb(const dvec3& v) { return "rgb " + pov_vector(v); }
double largest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }
bool grey(const dvec3& v) { return v.x == v.y && v.y == v.z; }

// A material with the scene's switches and ambient light applied.
struct Terms {
  dvec3 ambient, diffuse;  // c1 ka Ia, c1 kd
  dvec3 tint{1};           // of highlights: c1 ks over its largest channel
  double phong = 0;        // that channel
  dvec3 reflect, refract;  // c2, c3
  bool transparent = false;
};

Terms terms_of(const Scene& scene, const Material& material) {
  Terms terms;
  terms.ambient = material.local * material.ambient * scene.ambient;
  terms.diffuse = material.local * material.diffuse;
  const dvec3 specular = material.local * material.specular;
  terms.phong = largest(specular);
  if (!grey(specular)) terms.tint = glm::max(specular / terms.phong, dvec3(kLeastTint));
  terms.reflect = scene.trace.reflection ? material.reflect : dvec3(0);
  terms.refract = scene.trace.refraction ? material.refract : dvec3(0);
  terms.transparent = largest(terms.refract) > 0;
  return terms;
}

// The greatest distance from the eye, along an axis, of what has a place.
double extent(const Scene& scene) {
  const dvec3 eye = scene.camera.eye;
  dvec3 most = glm::abs(scene.camera.look_at - eye);
  for (const Sphere& sphere : scene.spheres)
    most = glm::max(most, glm::abs(sphere.center - eye) + sphere.radius);
  for (const Plane& plane : scene.planes)
    most = glm::max(most, dvec3(std::abs(dot(plane.point - eye, plane.normal))));
  for (const dvec3& position : scene.positions) most = glm::max(most, glm::abs(position - eye));
  return largest(most);
}

class Writer : PovText {
 public:
  Writer(const Scene& scene, const std::function<void(std::string_view)>& append)
      : PovText(append, std::exp2(std::floor(std::log2(kExtent / extent(scene))))), scene_(scene) {}

  void write() {
    head();
    for (const Light& each : scene_.lights) light(each, dvec3(1));
    for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) object(i);
  }

 private:
  void head();
  void light(const Light& light, const dvec3& tint);
  void layers(const std::string& keyword, const Material& material, const Terms& terms, const dvec3& through);
  void object(std::uint32_t index);
  void shape(std::uint32_t index, std::uint32_t material);

  const Scene& scene_;
};

void Writer::head() {
  line("// {}", printable(scene_.title, 1000));
  line("// Written by sidelight from {}.", printable(scene_.file, 1000));
  std::string command = "povray +IFILE.pov +OFILE.ppm";
  for (const std::string& option : pov_options(scene_)) command += " " + option;
  line("// All of the light:  {} +Q9", command);
  line("// Local light only:  {} +Q3", command);
  for (const PovLimit& limit : pov_limits(scene_)) line("// Not the same: {}", printable(limit.text, 2000));
  line("// One unit of the scene is {} here: POV-Ray's tolerances are absolute.", scale());
  line("#version 3.7;");
  line("global_settings {{ assumed_gamma 1 ambient_light rgb 1 max_trace_level {} adc_bailout 0 }}",
       std::min(scene_.trace.depth, kPovMostLevels));
  line("#default {{ finish {{ ambient 0 diffuse 0 }} }}");
  line("background {{ {} }}", rgb(scene_.background));
  // The same numbers as in Camera: pixel centres lie where ours do, x to the right and y up.
  const Camera camera = make_camera(scene_.camera, scene_.width, scene_.height, 1);
  const double aspect = static_cast<double>(scene_.width) / scene_.height;
  line("camera {{ perspective location {} direction {} right {} up {} }}", place(camera.eye),
       pov_vector(camera.forward), pov_vector(aspect * camera.right), pov_vector(camera.up));
}

// The light of one lamp, tinted where only objects of one tint see it.
void Writer::light(const Light& light, const dvec3& tint) {
  const dvec3 color = light.intensity * tint;
  if (light.directional) {
    // Only its distance matters, and only to shadows: beyond all that POV-Ray sees.
    const dvec3 to = scale() * scene_.camera.eye - 1e8 * light.direction;
    line("light_source {{ {} {} parallel point_at {} }}", pov_vector(to), rgb(color),
         place(scene_.camera.eye));
    return;
  }
  const Attenuation& a = light.attenuation;
  const int power = a.q2 > 0 ? 2 : 1;
  const double q = a.q2 > 0 ? a.q2 : a.q1;
  if (q == 0) {
    line("light_source {{ {} {} }}", place(light.position), rgb(color / a.q0));
    return;
  }
  // 1/(q0 + q d^power) = 1/(2 q0) · 2/(1 + (d/D)^power) for D^power = q0/q; where q0 = 0, one so small that 1 vanishes.
  const double q0 = a.q0 > 0 ? a.q0 : q * std::pow(1e-5 * extent(scene_), power);
  const double distance = std::min(std::pow(q0 / q, 1.0 / power), 1e100);  // q may be as good as 0
  line("light_source {{ {} {} fade_distance {:.17g} fade_power {} }}", place(light.position),
       rgb(color / (2 * q0)), scale() * distance, power);
}

void Writer::layers(const std::string& keyword, const Material& material, const Terms& terms,
                    const dvec3& through) {
  if (terms.transparent) {
    line("  {} {{ pigment {{ {} filter 1 }} }}", keyword, rgb(4.0 * through));
    line("  {} {{ pigment {{ {} transmit 0.5 }} finish {{ ambient 1 }} }}", keyword,
         rgb(4.0 * terms.ambient));
  } else {
    line("  {} {{ pigment {{ {} }} finish {{ ambient 1 }} }}", keyword, rgb(2.0 * terms.ambient));
  }
  line("  {} {{ pigment {{ {} transmit 0.5 }}", keyword, rgb(2.0 * terms.diffuse / terms.tint));
  // Without either, POV-Ray asks for no shadows, as we do not.
  line("    finish {{ diffuse {} phong {:.17g} phong_size {:.17g} reflection {{ {} }} }} }}",
       terms.diffuse == dvec3(0) ? 0 : 1, terms.phong, material.shininess, rgb(terms.reflect));
}

void Writer::object(std::uint32_t index) {
  const Object& object = scene_.objects[index];
  // A mesh has one part for each of its materials. Triangles without area are left out: they are never hit.
  std::set<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < object.count; ++i)
    if (object.kind != ObjectKind::mesh || !scene_.triangles[object.first + i].degenerate)
      parts.insert(primitive_material(scene_, object.first_primitive + i));

  for (const std::uint32_t part : parts) {
    const Material& material = scene_.materials[part];
    const Terms terms = terms_of(scene_, material);
    const bool tinted = terms.tint != dvec3(1);
    const bool casts = scene_.trace.shadows && material.casts_shadow;
    line("\n// Object {}, line {}: material {}", index + 1, object.where.line, printable(material.name));
    line("#declare Shape =");
    shape(index, part);
    // Highlights have the colour of the light: a tinted one needs lights of its own.
    if (tinted) {
      line("light_group {{");
      for (const Light& each : scene_.lights) light(each, terms.tint);
    }
    line("object {{ Shape");
    layers("texture", material, terms, terms.refract);
    if (terms.transparent) {
      // From within, POV-Ray gives total reflection the weight of the interior's fading alone: so that is c2 + c3,
      // independent of the way (power 0 halves 1 - color), and the layer takes it back for the refracted ray.
      const dvec3 total = terms.reflect + terms.refract;
      if (object.solid)
        layers("interior_texture", material, terms, terms.refract / glm::max(total, dvec3(1e-300)));
      line("  interior {{ ior {:.17g} fade_distance 1 fade_power 0 fade_color {} }}",
           object.solid ? material.ior : 1.0, rgb(2.0 * total - 1.0));
    }
    line("{}}}", casts && !terms.transparent ? "" : "  no_shadow ");
    if (tinted) line("  global_lights off }}");
    // Shadows are whole or none: behind glass, those of a twin that nothing else sees. It may not contain the eye, or
    // POV-Ray takes it for a second medium there: then a grain around the eye is left out.
    if (casts && terms.transparent) {
      const bool around_eye = object.solid && contains(scene_, object, scene_.camera.eye);
      if (around_eye)
        line("difference {{ object {{ Shape }} sphere {{ {}, 0.01 }}", place(scene_.camera.eye));
      else
        line("object {{ Shape");
      line("  pigment {{ rgb 0 }} no_image no_reflection }}");
    }
  }
}

void Writer::shape(std::uint32_t index, std::uint32_t material) {
  const Object& object = scene_.objects[index];
  if (object.kind == ObjectKind::sphere) {
    const Sphere& sphere = scene_.spheres[object.first];
    line("sphere {{ {}, {:.17g} }}", place(sphere.center), scale() * sphere.radius);
  } else if (object.kind == ObjectKind::plane) {
    const Plane& plane = scene_.planes[object.first];
    line("plane {{ {}, {:.17g} }}", pov_vector(plane.normal), scale() * dot(plane.normal, plane.point));
  } else {
    write_pov_mesh(*this, scene_, object, material);
  }
}

}  // namespace

std::vector<std::string> pov_options(const Scene& scene) {
  return {fmt::format("+W{}", scene.width),
          fmt::format("+H{}", scene.height),
          "+FP16",
          "-A",
          "-D",
          "File_Gamma=1.0",
          "Dither=off"};
}

void write_pov(const Scene& scene, const std::function<void(std::string_view)>& append) {
  Writer(scene, append).write();
}

}  // namespace sidelight
