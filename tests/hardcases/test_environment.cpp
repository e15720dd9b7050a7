// SPDX-License-Identifier: MIT
// What must not change a picture: threads that come and go at any time (DET-1), lanes that hold anything (DET-2), and
// the state, language and folder of the process (DET-4). Tiles, instruction sets: tests/agreement/test_promises.cpp.
#include <immintrin.h>

#include <cfenv>
#include <chrono>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <span>
#include <sstream>
#include <thread>

#include "common/model/shading.h"
#include "common/picture/image_io.h"
#include "common/scene/pov.h"
#include "common/scene/settings.h"
#include "tests/hardcases/relations.h"
#include "tests/hardcases/result.h"
#include "tests/support/program.h"
#include "tests/support/random.h"

using namespace sidelight;
using namespace sidelight::test;

namespace {

constexpr std::uint64_t kPicture = 17763555122872791742u;  // see "every build makes the same bytes"

}  // namespace

TEST_CASE("DET-1: threads that are held up at random change no bit") {
  std::uint64_t unlike = 0, pictures = 0;
  const int runs = tier() == "sanitized" ? 1 : 10;
  std::vector<std::string> files{kEverything, SIDELIGHT_SOURCE_DIR "/scenes/showcase.toml"};
  if (tier_list("held_up_scenes").front() == "all") {
    files = shipped_scenes();
    files.push_back(kEverything);
    for (const std::string& hard : hard_scene_files()) files.push_back(hard);
  }
  for (const std::string& file : files) {
    CAPTURE(file);
    const Scene scene = load_scene(file);
    const Camera camera = make_camera(scene.camera, 40, 30, 1);
    RenderOptions plain = keeping(kRaytraceLayers);
    plain.threads = 1;
    const Frame flat = rastered(scene, camera, plain), deep = traced(scene, camera, plain);
    for (const int threads : {2, 3, 4, 8, 16})
      for (int run = 0; run < runs; ++run) {
        RenderOptions options = plain;
        options.threads = threads;
        options.tile = 8;
        // Called by each worker after each of its items; sleeps for up to 0.3 ms, or not.
        std::atomic<std::uint64_t> calls{static_cast<std::uint64_t>(1000 * run + threads)};
        options.progress = [&](double) {
          const std::uint64_t bits = Random(calls++).bits();
          if (bits % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(bits / 4 % 300));
        };
        unlike += !differences(rastered(scene, camera, options), flat).empty();
        unlike += !differences(traced(scene, camera, options), deep).empty();
        pictures += 2;
      }
  }
  HardCase("DET-1").none("pictures with another bit, 2 to 16 threads, held up at random", unlike, pictures);
}

// The lanes beyond a batch's size are computed with the others: whatever they hold, the others do not hear of it.
TEST_CASE("DET-2: lanes that are not used may hold anything") {
  const Scene scene = everything();
  const ShadingTables tables = make_shading_tables(scene, needs_of(scene));
  const Camera camera = relation_camera(scene);
  VisibilityCounts counts;
  std::vector<std::pair<ShadingPoint<float>, std::uint32_t>> points;
  for (int X = 0; points.size() < 40 && X < 67; ++X) {
    const Ray ray{camera.eye, camera.direction(X, 30)};
    const Hit hit = nearest_of_all(scene, ray, kRayStart, counts);
    if (!hit.found()) continue;
    const Surface surface = surface_at(scene, ray, hit, counts);
    points.emplace_back(shading_point(tables, surface, ray), surface.material);
  }
  REQUIRE(points.size() == 40);
  std::uint64_t unlike = 0, looked_at = 0;
  for (const Isa isa : kIsas) {
    if (!machine_has(isa)) continue;
    for (const float poison :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
          std::numeric_limits<float>::denorm_min(), -3e38f})
      for (const int size : {1, 3, 7, 8, 9, 17, 40}) {
        ShadingBatch clean, poisoned;
        for (ShadingBatch::Rgb* rgb : {&poisoned.high, &poisoned.low, &poisoned.normal, &poisoned.to_viewer})
          for (auto& channel : *rgb) channel.fill(poison);
        for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
          clean.set(i, points[i].first, points[i].second);
          poisoned.set(i, points[i].first, points[i].second);
        }
        clean.size = poisoned.size = size;
        shade(isa, tables, clean);
        shade(isa, tables, poisoned);
        for (std::size_t c = 0; c < 3; ++c) {
          ++looked_at;
          unlike += std::memcmp(clean.unshadowed[c].data(), poisoned.unshadowed[c].data(),
                                static_cast<std::size_t>(size) * sizeof(float)) != 0;
        }
      }
  }
  HardCase("DET-2").none("batches changed by what unused lanes hold", unlike, looked_at);
}

// Debug, release and sanitized builds, with any compiler: all bits of the z-buffer's picture of everything, hashed. The
// number changes when the arithmetic of visibility or of the local model does, and then on purpose only; the pixels
// that moved are found with tests/images.
TEST_CASE("DET-2: every build makes the same bytes") {
  const Scene scene = everything();
  const Frame frame = rastered(scene, relation_camera(scene));
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  const auto add = [&](const auto& array) {
    for (const auto byte : std::as_bytes(std::span(array)))
      hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3;
  };
  for_each_array(frame, frame,
                 [&](const std::string&, const auto& array, const auto&, std::size_t) { add(array); });
  CAPTURE(hash);
  HardCase("DET-2").holds("the bytes of one picture are those of every other build", hash == kPicture);
}

// ---- DET-4 ----

namespace {

// A state of the floating-point unit, for as long as it lives.
struct FloatState {
  std::fenv_t before;
  explicit FloatState(int rounding, bool flush) {
    std::fegetenv(&before);
    std::fesetround(rounding);
    if (flush) _mm_setcsr(_mm_getcsr() | 0x8040u);
  }
  ~FloatState() { std::fesetenv(&before); }
};

}  // namespace

TEST_CASE("DET-4: the caller's rounding mode and denormals change no bit, and are given back") {
  const auto pictures = [] {
    const Scene scene = everything();
    const Camera camera = relation_camera(scene);
    return std::pair(rastered(scene, camera), traced(scene, camera));
  };
  const auto [flat, deep] = pictures();
  std::uint64_t unlike = 0, lost = 0, states = 0;
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST})
    for (const bool flush : {false, true}) {
      const FloatState state(rounding, flush);
      const auto [flat_here, deep_here] = pictures();
      ++states;
      unlike += !differences(flat_here, flat).empty() || !differences(deep_here, deep).empty();
      lost += std::fegetround() != rounding || ((_mm_getcsr() & 0x8040u) == 0x8040u) != flush;
    }
  const HardCase hard("DET-4");
  hard.none("states of the floating-point unit that change a bit", unlike, states);
  hard.none("states that are not given back", lost, states);
  const auto [flat_again, deep_again] = pictures();
  hard.holds("the same pictures a second time",
             differences(flat_again, flat).empty() && differences(deep_again, deep).empty());
}

namespace {

// A language with a comma for the decimal point and a point between thousands, which no machine need have installed:
// "comma" in the folder that LOCPATH names. localedef writes it and complains of all that it lacks.
const std::string kCommaSource =
    "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n";
bool make_comma(const Workplace& here) {
  write_bytes(here / "comma.source", kCommaSource);
  here.command({"localedef", "-c", "-i", here / "comma.source", "-f", "ANSI_X3.4-1968", here / "comma"});
  return std::filesystem::exists(here / "comma/LC_NUMERIC");
}

// What C++ streams write and read by.
struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// That language in this process, in C and in C++, for as long as it lives.
class CommaInUse {
 public:
  explicit CommaInUse(const Workplace& here) {
    ::setenv("LOCPATH", (here / ".").c_str(), 1);
    set_ = std::setlocale(LC_ALL, "comma") != nullptr;
  }
  ~CommaInUse() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
    ::unsetenv("LOCPATH");
  }
  // Whether both C and C++ do as it says: 1.5 is "1,5".
  bool holds() const {
    char text[8];
    std::snprintf(text, sizeof text, "%.1f", 1.5);
    std::ostringstream stream;
    stream << 1.5;
    return set_ && std::string(text) == "1,5" && stream.str() == "1,5";
  }

 private:
  bool set_ = false;
  std::locale before_ = std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
};

}  // namespace

TEST_CASE("DET-4: language, time zone and folder change no byte of a file") {
  const Workplace here;
  if (!make_comma(here)) return skip_test("localedef makes no language");
  std::filesystem::create_directories(here / "elsewhere/deep");
  const auto made = [&](const std::string& way, const std::string& verb) {
    const std::string command = way + " \"$0\" " + verb;
    CAPTURE(command);
    const Outcome outcome = here.run_in_shell(command, {here / "."});
    CHECK(outcome.code == 0);
    return outcome.out;
  };
  const auto picture = [&](const std::string& way) {
    made(way, "render \"$1/good.toml\" -r 64x48 -q --layers all -o \"$1/a.exr\"");
    return read_bytes(here / "a.exr");
  };
  const auto words = [&](const std::string& way) {
    made(way, "convert \"$1/good.toml\" \"$1/a.pov\"");
    return read_bytes(here / "a.pov") + made(way, "info \"$1/good.toml\"");
  };
  // glibc 2.36 never frees the list of folders that newlocale makes of LOCPATH, and libraries call newlocale.
  const std::string comma = "ASAN_OPTIONS=detect_leaks=0 LOCPATH=\"$1\" LC_ALL=comma", plain = picture("");
  std::uint64_t unlike = 0, ways = 0;
  for (const std::string& way : std::vector<std::string>{
           comma, "LC_ALL=C LANG=tr_TR.UTF-8", "LC_ALL=C.UTF-8 TZ=Pacific/Auckland", "TZ=UTC-13",
           "cd \"$1/elsewhere/deep\";", "umask 077;", "HOME=/nonexistent", ""}) {
    ++ways;
    unlike += picture(way) != plain;
  }
  const HardCase hard("DET-4");
  hard.none("environments that change a byte of the EXR", unlike, ways);
  hard.holds("a decimal comma changes no byte of the POV-Ray scene and of what is printed",
             words(comma) == words(""));
}

// Who links the libraries may have called setlocale.
TEST_CASE("DET-4: a caller's comma for the decimal point changes no number that is read or written") {
  const Workplace here;
  if (!make_comma(here)) return skip_test("localedef makes no language");
  write_bytes(here / "mesh.obj",
              "mtllib mesh.mtl\nusemtl a\nv 0.25 0 0\nv 1.5 0 0\nv 0 1e-1 12345.5\nf 1 2 3\n");
  write_bytes(here / "mesh.mtl", "newmtl a\nKd 0.125 0.25 0.5\nNs 1234.5\n");
  write_bytes(here / "scene.toml",
              kGoodScene +
                  "[[mesh]]\nfile = 'mesh.obj'\n[[step]]\ntext = 'a'\n"
                  "set = { \"picture.size\" = [1280, 1024], \"camera.vertical_fov\" = 1.5 }\n");
  const auto all_text = [&] {
    std::vector<std::string> texts;
    for (const std::string& file : {here / "scene.toml", kEverything}) {
      const Scene scene = load_scene(file);
      Scene other = scene;
      other.ambient = {0.125, 1234.5, 1e-7};
      std::string text = with_settings(read_bytes(file), settings_between(scene, other), file);
      for (const Step& step : scene.steps)
        for (const auto& [key, value] : step.set) text += key + " = " + value + '\n';
      write_pov(scene, [&](std::string_view piece) { text += piece; });
      const Frame frame = traced(scene, relation_camera(scene));
      write_exr(here / "a.exr", frame, {{"scene", scene.hash}});
      texts.push_back(text + read_bytes(here / "a.exr"));
    }
    return texts;
  };
  const auto expected = all_text();
  const CommaInUse comma(here);
  REQUIRE(comma.holds());
  HardCase("DET-4").none(
      "scenes that are read or written otherwise where a caller's decimal point is a comma",
      all_text() != expected, expected.size());
}
