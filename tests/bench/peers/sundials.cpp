#include <stdexcept>

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include "tests/bench/peers/method.hpp"

namespace adstar::peers {
namespace {

int rate(realtype t, N_Vector y, N_Vector dydt, void* the_case) {
  plain_rate(*static_cast<const Case*>(the_case), NV_DATA_S(y), NV_DATA_S(dydt), t);
  return 0;
}

void must(int status, const char* what) {
  if (status < 0) {
    throw std::runtime_error(what);
  }
}

Method erk(const char* name, int order) {
  return {name, false, false, [order](const Case& the_case, int steps) {
            SUNContext context = nullptr;
            must(SUNContext_Create(nullptr, &context), "SUNContext_Create");
            N_Vector y = N_VNew_Serial(7, context);
            const double start[] = {1,
                                    0,
                                    0,
                                    0,
                                    the_case.omega_B_rad_s.x,
                                    the_case.omega_B_rad_s.y,
                                    the_case.omega_B_rad_s.z};
            for (int i = 0; i < 7; ++i) {
              NV_Ith_S(y, i) = start[i];
            }
            void* memory = ERKStepCreate(rate, 0, y, context);
            must(memory == nullptr ? -1 : 0, "ERKStepCreate");
            must(ERKStepSetUserData(memory, const_cast<Case*>(&the_case)), "ERKStepSetUserData");
            must(ERKStepSetOrder(memory, order), "ERKStepSetOrder");
            must(ERKStepSetFixedStep(memory, the_case.horizon_s / steps), "ERKStepSetFixedStep");
            must(ERKStepSetMaxNumSteps(memory, steps + 10L), "ERKStepSetMaxNumSteps");
            must(ERKStepSetStopTime(memory, the_case.horizon_s), "ERKStepSetStopTime");
            realtype t = 0;
            must(ERKStepEvolve(memory, the_case.horizon_s, y, &t, ARK_NORMAL), "ERKStepEvolve");
            const End end = end_of(the_case, NV_DATA_S(y));
            ERKStepFree(&memory);
            N_VDestroy(y);
            SUNContext_Free(&context);
            return end;
          }};
}

}  // namespace

std::vector<Method> sundials_methods() {
  return {erk("sundials_erk4", 4), erk("sundials_erk6", 6), erk("sundials_erk8", 8)};
}

}  // namespace adstar::peers
