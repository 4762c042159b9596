#include "tests/support/compile_schemes.hpp"

namespace adstar::test {

constinit const std::array<CompiledScheme, kSchemes> kEvenSchemes = compile_half<0>();

}  // namespace adstar::test
