#pragma once
// The parts of adstar._core. Everything in them is the service's own code: what is here only translates.

#include <pybind11/pybind11.h>

namespace adstar::python {

/// Scene, SceneError, propagate(), accuracy()
void bind_scene(pybind11::module_& module);
/// Body, schemes(), rotation_matrices()
void bind_body(pybind11::module_& module);
/// RecordingError, read_recording()
void bind_recording(pybind11::module_& module);

}  // namespace adstar::python
