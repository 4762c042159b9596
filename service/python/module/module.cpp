// adstar._core: what the package adstar (service/python/adstar) stands on.

#include "service/python/module/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = ADSTAR_VERSION;
  adstar::python::bind_scene(module);
  adstar::python::bind_body(module);
  adstar::python::bind_recording(module);
}
