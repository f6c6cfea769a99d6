// The library's public face (validate/api) for Python: arrays in, arrays out. gnomon/__init__.py
// has what is easier said in Python.

#include <gnomon/compare.h>
#include <gnomon/horizon.h>
#include <gnomon/study.h>
#include <gnomon/truth.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace py::literals;

namespace {

/// An array of some type in C order; another type is converted.
template <typename T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

template <typename T>
std::span<const T> spanOf(const Array<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// Values that Python owns from now on, without a copy.
template <typename T>
py::array_t<T> arrayOf(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* data) { delete static_cast<std::vector<T>*>(data); });
  return py::array_t<T>(std::move(shape), kept->data(), owner);
}

/// Ends work from within, when a signal has raised an exception in Python.
struct Interrupted {};

/// To be called by long work now and then, where it reports how far it is. Throws Interrupted where
/// the work has to end.
using Stop = std::function<void()>;

/// Does long work on another thread, while this one looks after Python's signals: only Python's
/// main thread may. Python's other threads run meanwhile.
/// @param work  gets a Stop
template <typename Work>
auto interruptibly(const Work& work) {
  gnomon::StopSwitch whole;
  std::atomic<bool> isInterrupted = false;
  std::optional<py::error_already_set> raised;  // by Python's handler of the signal
  std::optional<decltype(work(Stop()))> result;
  {
    const py::gil_scoped_release released;
    auto done = std::async(std::launch::async, [&] {
      whole.run([&] {
        result.emplace(work([&] {
          if (isInterrupted) throw Interrupted();
        }));
      });
    });
    while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
      const py::gil_scoped_acquire acquired;
      if (isInterrupted || PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      isInterrupted = true;
      whole.stop();
    }
    try {
      done.get();
    } catch (const Interrupted&) {
    } catch (const gnomon::Exception& failure) {
      if (failure.kind() != gnomon::FailureKind::stopped) throw;
    }
  }
  if (raised) throw py::error_already_set(*raised);
  return std::move(*result);
}

/// A map of masks or of shares.
template <typename Map, typename T>
Map mapOf(const Array<T>& array) {
  return {static_cast<int>(array.shape(1)),
          static_cast<int>(array.shape(0)),
          {array.data(), array.data() + array.size()}};
}

gnomon::MaskFigures figuresOf(const py::array& candidate, const py::array& truth,
                              const gnomon::CompareOptions& options) {
  if (truth.dtype().kind() == 'f') {
    const auto answers = mapOf<gnomon::ShareMap, float>(candidate);
    const auto expected = mapOf<gnomon::ShareMap, float>(truth);
    return interruptibly(
        [&](const Stop&) { return gnomon::compareShares(answers, expected, options); });
  }
  const auto answers = mapOf<gnomon::MaskMap, std::uint8_t>(candidate);
  const auto expected = mapOf<gnomon::MaskMap, std::uint8_t>(truth);
  return interruptibly(
      [&](const Stop&) { return gnomon::compareMasks(answers, expected, options); });
}

py::dict compare(const py::array& candidate, const py::array& truth,
                 const std::optional<Array<bool>>& roi,
                 const std::optional<Array<double>>& weights) {
  gnomon::CompareOptions options;
  if (roi) {
    options.region = {reinterpret_cast<const std::uint8_t*>(roi->data()),
                      static_cast<std::size_t>(roi->size())};
  }
  if (weights) options.weights = spanOf(*weights);
  const gnomon::MaskFigures figures = figuresOf(candidate, truth, options);
  py::dict result("tp"_a = figures.truePositive, "fp"_a = figures.falsePositive,
                  "fn"_a = figures.falseNegative, "tn"_a = figures.trueNegative,
                  "samples"_a = figures.samples);
  py::dict undefined;
  for (const gnomon::MaskMetric& metric : figures.metrics) {
    result[py::str(metric.name)] = metric.value;
    if (!metric.value) undefined[py::str(metric.name)] = metric.reason;
  }
  result["error_interval"] = figures.errorInterval;
  if (!figures.errorInterval) undefined["error_interval"] = figures.intervalReason;
  result["undefined"] = undefined;
  result["notice"] = figures.notice.empty() ? py::object(py::none()) : py::str(figures.notice);
  return result;
}

py::array_t<std::uint8_t> readMask(const std::filesystem::path& file) {
  gnomon::MaskMap mask = interruptibly([&](const Stop&) { return gnomon::readMask(file); });
  return arrayOf(std::move(mask.samples), {mask.height, mask.width});
}

py::array_t<float> readShares(const std::filesystem::path& file) {
  gnomon::ShareMap map = interruptibly([&](const Stop&) { return gnomon::readShares(file); });
  return arrayOf(std::move(map.shares), {map.height, map.width});
}

gnomon::HeightMap heightMapOf(const Array<float>& heights, bool repeats) {
  return {static_cast<int>(heights.shape(1)), static_cast<int>(heights.shape(0)), spanOf(heights),
          repeats};
}

py::tuple horizons(const Array<float>& heights, int azimuths, double radius, bool repeats) {
  const gnomon::HeightMap map = heightMapOf(heights, repeats);
  auto* kept = new gnomon::HorizonMaps;
  const py::capsule owner(kept, [](void* data) { delete static_cast<gnomon::HorizonMaps*>(data); });
  *kept = interruptibly([&](const Stop& stop) {
    return gnomon::bakeHorizons(map, azimuths, radius, [&](double) { stop(); });
  });
  const std::vector<py::ssize_t> shape = {kept->azimuths, kept->height, kept->width};
  return py::make_tuple(py::array_t<float>(shape, kept->slopes.data(), owner),
                        py::array_t<float>(shape, kept->distances.data(), owner));
}

gnomon::Surface makeShape(const std::string& shape, const gnomon::ShapeKeys& keys) {
  return interruptibly([&](const Stop&) { return gnomon::makeShape(shape, keys); });
}

gnomon::Surface readSurface(const std::filesystem::path& file, const std::string& scheme) {
  return interruptibly([&](const Stop&) { return gnomon::readSurface(file, scheme); });
}

gnomon::Surface makeSurface(const Array<double>& positions, const Array<int>& faces,
                            const Array<double>& uvs, const Array<int>& faceUvs, bool polygons) {
  const gnomon::ControlMesh mesh{spanOf(positions), spanOf(faces),       spanOf(uvs),
                                 spanOf(faceUvs),   faces.shape(1) == 3, polygons};
  return interruptibly([&](const Stop&) { return gnomon::makeSurface(mesh); });
}

gnomon::SurfaceSamples atlas(const gnomon::Surface& surface, int samples) {
  return interruptibly([&](const Stop&) { return gnomon::atlasSamples(surface, samples); });
}

gnomon::SurfaceSamples camera(const gnomon::Surface& surface, const std::array<double, 3>& eye,
                              const std::array<double, 3>& target, const std::array<double, 3>& up,
                              double fov, int width, int height, int subdivisions) {
  return interruptibly([&](const Stop&) {
    return gnomon::cameraSamples(surface, {eye, target, up, fov, width, height}, subdivisions);
  });
}

/// One member of every place, as an array that shows the samples' own memory.
template <typename T>
py::array_t<T> memberOf(const py::object& samples, T gnomon::SurfacePlace::*member) {
  const auto& grid = samples.cast<const gnomon::SurfaceSamples&>();
  constexpr py::ssize_t stride = sizeof(gnomon::SurfacePlace);
  const T* first = grid.places.empty() ? nullptr : &(grid.places.front().*member);
  return py::array_t<T>({grid.height, grid.width}, {stride * grid.width, stride}, first, samples);
}

py::object weightsOf(const py::object& samples) {
  const auto& grid = samples.cast<const gnomon::SurfaceSamples&>();
  if (grid.weights.empty()) return py::none();
  return py::array_t<double>({grid.height, grid.width}, grid.weights.data(), samples);
}

gnomon::SurfaceSamples samplesOf(const Array<int>& face, const Array<float>& s,
                                 const Array<float>& t) {
  gnomon::SurfaceSamples samples{
      static_cast<int>(face.shape(1)), static_cast<int>(face.shape(0)), {}, {}};
  for (py::ssize_t i = 0; i < face.size(); ++i) {
    samples.places.push_back({face.data()[i], s.data()[i], t.data()[i]});
  }
  return samples;
}

py::list trace(const gnomon::Surface& surface, const Array<float>& heights,
               const gnomon::SurfaceSamples& samples,
               const std::vector<std::array<double, 3>>& lights,
               const std::array<double, 2>& repeats, bool heightsInTexels, bool mapRepeats,
               std::optional<double> step, std::optional<double> radius,
               const std::vector<double>& lightRadii, int directions) {
  const gnomon::Displacement relief{heightMapOf(heights, mapRepeats), repeats, heightsInTexels};
  std::vector<gnomon::ShadowTruth> truths = interruptibly([&](const Stop& stop) {
    return gnomon::traceTruth(surface, relief, samples, lights,
                              {step, radius, lightRadii, directions, [&](double) { stop(); }});
  });
  py::list list;
  for (gnomon::ShadowTruth& truth : truths) {
    const std::vector<py::ssize_t> shape = {truth.height, truth.width};
    py::object shares = py::none();
    if (!truth.shares.empty()) shares = arrayOf(std::move(truth.shares), shape);
    list.append(py::dict("mask"_a = arrayOf(std::move(truth.mask), shape),
                         "regions"_a = arrayOf(std::move(truth.regions), shape),
                         "uncertainty"_a = truth.uncertainty, "shares"_a = std::move(shares)));
  }
  return list;
}

py::tuple run(const std::filesystem::path& study, const std::filesystem::path& out,
              const std::vector<std::string>& methods, const std::vector<std::string>& settings,
              bool quick, bool cache, const py::object& progress) {
  const gnomon::RunResult result = interruptibly([&](const Stop& stop) {
    gnomon::RunOptions options{out, methods, settings, quick, cache, {}};
    options.progress = [&](std::string_view stage, double share) {
      stop();
      if (progress.is_none()) return;
      const py::gil_scoped_acquire acquired;
      progress(std::string(stage), share);
    };
    return gnomon::runStudy(study, options);
  });
  return py::make_tuple(result.summary, result.passed, result.failures);
}

/// The types of Python's exceptions, by the kind of failure.
void addExceptions(py::module_& module) {
  static const py::exception<gnomon::Exception> any(module, "Error", PyExc_RuntimeError);
  static const py::exception<gnomon::Exception> input(
      module, "InputError", py::make_tuple(any, py::handle(PyExc_ValueError)));
  static const py::exception<gnomon::Exception> noGl(module, "NoOpenGLError", any);
  any.attr("__doc__") = "Gnomon could not do what it was asked for.";
  input.attr("__doc__") =
      "An argument, file, study, mesh or shader is missing, malformed or out of range.";
  noGl.attr("__doc__") = "This machine has no OpenGL 4.5.";
  // pybind11 asks for a function that takes the pointer by value.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const gnomon::Exception& error) {
      const py::handle type = error.kind() == gnomon::FailureKind::badInput   ? input
                              : error.kind() == gnomon::FailureKind::noOpenGl ? noGl
                                                                              : any;
      PyErr_SetString(type.ptr(), error.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_gnomon, module) {
  module.doc() = "The compiled part of gnomon: takes arguments that gnomon.arguments has checked.";
  module.attr("__version__") = GNOMON_VERSION;
  addExceptions(module);
  py::class_<gnomon::Surface>(
      module, "Surface",
      "A smooth limit surface with texture coordinates. `make_shape`, `read_surface` and "
      "`make_surface` make it.")
      .def_property_readonly("face_count", &gnomon::Surface::faceCount,
                             "Faces, each a square of parameters (s, t) from 0 to 1.")
      .def("__repr__", [](const gnomon::Surface& surface) {
        const int faces = surface.faceCount();
        return "<gnomon.Surface of " + std::to_string(faces) + (faces == 1 ? " face>" : " faces>");
      });
  py::class_<gnomon::SurfaceSamples>(module, "Samples", "What gnomon.Samples holds.")
      .def(py::init(&samplesOf), "face"_a, "s"_a, "t"_a)
      .def_property_readonly(
          "face",
          [](const py::object& self) { return memberOf(self, &gnomon::SurfacePlace::face); })
      .def_property_readonly(
          "s", [](const py::object& self) { return memberOf(self, &gnomon::SurfacePlace::s); })
      .def_property_readonly(
          "t", [](const py::object& self) { return memberOf(self, &gnomon::SurfacePlace::t); })
      .def_property_readonly("weights", &weightsOf);
  module.def("make_shape", &makeShape, "shape"_a, "keys"_a);
  module.def("read_surface", &readSurface, "file"_a, "scheme"_a);
  module.def("make_surface", &makeSurface, "positions"_a, "faces"_a, "uvs"_a, "face_uvs"_a,
             "polygons"_a);
  module.def("atlas", &atlas, "surface"_a, "samples"_a);
  module.def("camera", &camera, "surface"_a, "eye"_a, "target"_a, "up"_a, "fov"_a, "width"_a,
             "height"_a, "subdivisions"_a);
  module.def("horizons", &horizons, "heights"_a, "azimuths"_a, "radius"_a, "repeats"_a);
  module.def("trace", &trace, "surface"_a, "heights"_a, "samples"_a, "lights"_a, "repeats"_a,
             "heights_in_texels"_a, "map_repeats"_a, "step"_a, "radius"_a, "light_radii"_a,
             "directions"_a);
  module.def("compare", &compare, "candidate"_a, "truth"_a, "roi"_a, "weights"_a);
  module.def("read_mask", &readMask, "file"_a);
  module.def("read_shares", &readShares, "file"_a);
  module.def("run", &run, "study"_a, "out"_a, "methods"_a, "settings"_a, "quick"_a, "cache"_a,
             "progress"_a);
}
