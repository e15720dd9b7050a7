// SPDX-License-Identifier: MIT
// What every verb shares: the flags that choose scene, size and effort, and turning them into a loaded scene, a camera
// and render options. One definition of each flag, so that a flag means the same everywhere.
#pragma once

#include <CLI/App.hpp>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "common/clock.h"
#include "common/picture/frame.h"
#include "common/picture/image_io.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "common/scene/settings.h"
#include "viewer/commands/fault_flags.h"

namespace sidelight {

struct JobFlags {
  std::string scene;
  std::string size;  // -r WxH
  std::string crop;  // --crop x0,y0,x1,y1
  std::string isa;   // --isa
  int threads = 0;   // -j
  int spp = 1;       // --spp
  int depth = 0;     // --depth; 0: as the scene says
  bool no_shadows = false, no_reflection = false, no_refraction = false, local = false;
  bool quiet = false;            // -q
  bool no_times = false;         // --no-times
  std::string primary = "rays";  // --primary, where the verb has it: or "raster"
  FaultFlags faults;             // where the verb has them
  std::vector<std::string> set;  // --set KEY=VALUE, where the verb has it

  bool from_raster() const { return primary == "raster"; }
};

// Adds the flags to a verb, with their help texts: all of them, those that say how a scene is rendered, or -q alone.
void add_job_flags(CLI::App& verb, JobFlags& flags);
void add_render_flags(CLI::App& verb, JobFlags& flags);
void add_quiet_flag(CLI::App& verb, JobFlags& flags);
// Takes those back that would change nothing in this verb.
void remove_flags(CLI::App& verb, std::initializer_list<const char*> names);
// --primary: who finds what each sample shows (renderers.h, with_primary).
void add_primary_flag(CLI::App& verb, JobFlags& flags);

// "640x480", sides from 1 to `longest`. Throws UsageError, which names the flag.
glm::ivec2 parse_size(const std::string& text, const char* flag, int longest = 65535);

// "x,y" with 0 <= x < width and 0 <= y < height. Throws UsageError, which names the flag and the two numbers.
glm::ivec2 parse_pixel(const std::string& text, int width, int height, const char* flag,
                       const char* names = "x,y");

// Throws UsageError where what is written would take the place of what is read or written besides; each file comes
// with its name on the command line, and may be empty: not asked for.
void check_apart(const char* name, const std::string& file, const char* written_name,
                 const std::string& written);

// A scene ready to be rendered.
struct Job {
  JobFlags flags;
  Scene scene;                         // overrides applied; its title says which faults are on
  std::optional<Scene> untessellated;  // the same with its spheres, where --tessellate took them
  Camera camera;
  RenderOptions options;           // layers and keep_samples are the verb's to set
  std::vector<std::string> files;  // that were read: the scene's, then those of its meshes
  double load_ms = 0;
};

// Loads and validates, with values of the file replaced by `set`, then by --set (toml.h: load_scene_with). Prints the
// scene's warnings to stderr unless quiet. Throws InputError, UsageError, Interrupted.
Job load_job(const JobFlags& flags, const Settings& set = {});

// Refuses, before anything is allocated, what the machine's memory cannot hold: an InputError that names the size.
// Counts `pairs` times two frames with the job's options: both pictures, or one and its file.
void check_memory(const Job& job, int pairs = 1);
// The same for n x n samples a pixel of a scene as it stands; and whether it would refuse.
void check_memory(const Scene& scene, int n, const RenderOptions& options, int pairs = 1);
bool fits_memory(const Scene& scene, int n, const RenderOptions& options, int pairs = 1);

// The settings of the job, for a picture's metadata: scene, hash, size, samples, depth, switches, version.
Metadata job_metadata(const Job& job, const std::string& renderer);
// The same of a scene that was changed since it was loaded, and of the samples and surfaces that `flags` asks for.
Metadata picture_metadata(const JobFlags& flags, const Scene& scene, const Faults& faults,
                          const std::string& renderer);

// What to type into a shell to run `verb` on the scene as this job renders it: "sidelight explain scene.toml --spp 4".
// The crop is left out, since pixels count from the whole picture's corner.
std::string command_line(const Job& job, std::string_view verb);

}  // namespace sidelight
