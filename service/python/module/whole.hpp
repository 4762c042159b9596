#pragma once
// Objects that Python has without their __init__(), as `Body.__new__(Body)`.

#include <cstddef>
#include <new>

#include <pybind11/pybind11.h>

namespace adstar::python {

/// Base of what Python has. When there is no object yet, pybind11 asks its class for memory and goes on with whatever is in
/// there: TypeError instead. Whole ones are made with `::new`.
struct Whole {
  static void* operator new(std::size_t /*size*/) {
    throw pybind11::type_error("its __init__() was not called; make it anew");
  }
  static void operator delete(void* memory) { ::operator delete(memory); }
};

}  // namespace adstar::python
