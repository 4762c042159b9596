// Every scheme's measured order, in 113 bits, against the plain equations extrapolated to order 16.
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "adstar/propagator.hpp"
#include "tests/support/plain_motion.hpp"
#include "tests/support/schemes.hpp"

namespace adstar {
namespace {

using test::PlainMotion;
using test::PlainState;
using test::Quad;
using test::QuadMatrix;
using V = Vec3<Quad>;

QuadMatrix diagonal() {
  QuadMatrix J = QuadMatrix::Zero();
  J(0, 0) = Quad("0.9144");
  J(1, 1) = Quad("1.098");
  J(2, 2) = Quad("1.66");
  return J;
}

QuadMatrix full() {
  QuadMatrix J;
  J << Quad("1.2"), Quad("-0.15"), Quad("0.08"), Quad("-0.15"), Quad("1.0"), Quad("0.11"),
      Quad("0.08"), Quad("0.11"), Quad("1.5");
  return J;
}

/// A torque, told to the library by its frame and to the plain equations as a body torque.
struct Load {
  const char* name;
  std::function<TorqueSample<Quad>(const Quad&, const Quat<Quad>&, const V&)>
      torque;  ///< none: free
};

std::vector<Load> loads() {
  return {
      {"free", nullptr},
      {"body torque of time",
       [](const Quad& t, const Quat<Quad>&, const V&) {
         return TorqueSample<Quad>{{sin(2 * t) / 3, cos(3 * t) / 4, Quad("0.2")}, {}};
       }},
      {"inertial torque of time",
       [](const Quad& t, const Quat<Quad>&, const V&) {
         return TorqueSample<Quad>{{}, {Quad("0.3"), sin(t) / 2, t / 4}};
       }},
      {"torque of attitude and angular velocity",
       [](const Quad&, const Quat<Quad>& q, const V& omega) {
         const V down = rotate_inverse(q, V{Quad(0), Quad(0), Quad(1)});
         return TorqueSample<Quad>{
             cross(down, V{Quad("0.3"), Quad("0.2"), Quad("-0.4")}) - Quad("0.3") * omega, {}};
       }},
      {"both frames at once",
       [](const Quad& t, const Quat<Quad>&, const V& omega) {
         return TorqueSample<Quad>{Quad("-0.1") * omega, {sin(t) / 3, Quad("0.1"), Quad("-0.2")}};
       }},
  };
}

struct Errors {
  Quad attitude, momentum, energy;
};

template <class Scheme>
class OrderOf : public testing::Test {
 public:
  static constexpr int kSeconds = 2;
  /// Steps enough to be in the asymptotic range: many for Dormand and Prince, whose leading errors are
  /// small beside the next; few for order eight, or nothing would be left of 113 bits.
  static constexpr bool kDop853 = std::string_view(Scheme::kName).ends_with("dop853");
  static constexpr int kCoarse = Scheme::kOrder == 5              ? 2048
                                 : Scheme::kOrder > 6 && !kDop853 ? 64
                                                                  : 128;
  /// Order 16 is seen between round-off and too coarse only: a splitting's longest drift, a quarter to
  /// half of a step, is to last some 0.3 s.
  static constexpr int free_coarse() {
    if constexpr (requires { Scheme::kWeakReach; }) {
      return Scheme::kWeakReach > 0.4 ? 3 : 2;
    }
    return test::free_order<Scheme>() > 8 ? 2 : kCoarse;
  }
  static constexpr int kFreeCoarse = free_coarse();

  static State<Quad> initial(const RigidBody<Quad>& body) {
    const Quat<Quad> q = normalised(Quat<Quad>{Quad(3), Quad(-1), Quad(2), Quad(1)});
    const V omega{Quad("0.45549"), Quad("0.82623"), Quad("-0.33476")};
    return make_state(q, rotate(q, body.momentum(omega)));
  }

  static PlainState truth(const QuadMatrix& J, const Load& load) {
    const State<Quad> start = initial(RigidBody<Quad>(J));
    test::PlainTorque torque;
    if (load.torque) {
      torque = [&load](const Quad& t, const Quat<Quad>& q, const V& omega) {
        const TorqueSample<Quad> tau = load.torque(t, q, omega);
        return tau.body + rotate_inverse(q, tau.inertial);
      };
    }
    // Free motion finer: free schemes go to order 16.
    return PlainMotion(J, torque).run(test::plain_state(start.q_IB, body_momentum(start)), 0,
                                      kSeconds, load.torque ? 64 : 128);
  }

  /// Errors at the end of a run of `steps` steps.
  static Errors errors(const QuadMatrix& J, const Load& load, const PlainState& exact, int steps) {
    const BodyOf<Scheme, Quad> body{RigidBody<Quad>(J)};
    State<Quad> state = initial(body);
    const Quad energy_0 = body.energy(body_momentum(state));
    const Quad h = Quad(kSeconds) / steps;
    for (int n = 0; n < steps; ++n) {
      if (!load.torque) {
        Scheme::step(body, state, h, NoTorque{});
        continue;
      }
      Scheme::step(body, state, h, mixed_torque([&](const Stage<Quad>& stage) {
                     return load.torque(n * h + stage.time_s, stage.q_IB(), stage.omega_B);
                   }));
    }
    const Quat<Quad> q = normalised(exact.q_IB());
    return {angle_between(q, state.q_IB), norm(rotate(q, exact.Pi_B()) - state.H_I.value()),
            abs(body.energy(body_momentum(state)) - energy_0 - state.work.value)};
  }

  /// A quadrature of high order leaves nothing but round-off, of the run and of the truth, in which there is no order:
  /// with fewer steps there is.
  static double momentum_order(const QuadMatrix& J, const Load& load, const PlainState& exact,
                               int steps, Errors coarse, Errors fine) {
    const Quad round_off("1e-29");
    while (fine.momentum < round_off && steps > 2) {
      steps /= 2;
      fine = coarse;
      coarse = errors(J, load, exact, steps);
    }
    return order(coarse.momentum, fine.momentum);
  }

  static double order(const Quad& coarse, const Quad& fine) {
    return std::log2(static_cast<double>(coarse / fine));
  }
};

TYPED_TEST_SUITE(OrderOf, test::ForcedSchemeTypes);

TYPED_TEST(OrderOf, is_as_stated_for_every_tensor_and_torque) {
  if constexpr (TypeParam::kOrder == kExactOrder) {
    GTEST_SKIP() << "no error but round-off: its own test judges it";
  }
  constexpr int kStated = TypeParam::kOrder;
  for (const bool diagonal_tensor : {true, false}) {
    const QuadMatrix J = diagonal_tensor ? diagonal() : full();
    for (const Load& load : loads()) {
      SCOPED_TRACE(std::string(load.name) +
                   (diagonal_tensor ? ", diagonal tensor" : ", full tensor"));
      const PlainState exact = this->truth(J, load);
      const int steps = load.torque ? this->kCoarse : this->kFreeCoarse;
      const Errors coarse = this->errors(J, load, exact, steps);
      const Errors fine = this->errors(J, load, exact, 2 * steps);
      // Kicks alone may be a quadrature of higher order.
      constexpr bool kSplitting = test::free_order<TypeParam>() != kStated;
      const double order = this->order(coarse.attitude, fine.attitude);
      if (load.torque && kSplitting) {
        EXPECT_GT(order, kStated - 0.15);
      } else {
        EXPECT_NEAR(order, test::free_order<TypeParam>(), 0.15);
      }
      if (!TypeParam::kClaims.exact_momentum || (load.torque && kSplitting)) {
        EXPECT_GT(this->momentum_order(J, load, exact, steps, coarse, fine), kStated - 0.25);
      } else if (load.torque) {
        EXPECT_NEAR(this->order(coarse.momentum, fine.momentum), kStated, 0.25);
      } else {
        EXPECT_LT(test::to_double(fine.momentum), 1e-20) << "the truth itself has moved";
      }
      if (TypeParam::kClaims.exact_energy) {
        EXPECT_LT(test::to_double(fine.energy), 1e-28);
        continue;
      }
      // Energy may converge faster, never slower.
      EXPECT_GT(this->order(coarse.energy, fine.energy), kStated - 0.25);
    }
  }
}

TYPED_TEST(OrderOf, is_as_stated_against_the_closed_form_of_an_axisymmetric_body) {
  if constexpr (TypeParam::kOrder == kExactOrder) {
    GTEST_SKIP() << "no error but round-off: its own test judges it";
  }
  // J = (a, a, c): R(t) = exp(hat(H) t/a) R_0 exp(hat(z) (1 - c/a) omega_z t).
  QuadMatrix J = QuadMatrix::Zero();
  const Quad a("1.3"), c("0.7");
  J(0, 0) = J(1, 1) = a;
  J(2, 2) = c;
  const BodyOf<TypeParam, Quad> body{RigidBody<Quad>(J)};
  const State<Quad> start = this->initial(body);
  const V omega_B = body.angular_velocity(body_momentum(start));
  const Quad T(this->kSeconds);
  const auto turn = [](const V& psi) {
    const Quad half = norm(psi) / 2;
    const Quad s = sin(half) / (2 * half);
    return Quat<Quad>{cos(half), s * psi.x, s * psi.y, s * psi.z};
  };
  const Quat<Quad> exact = turn((T / a) * start.H_I.value()) * start.q_IB *
                           turn(V{Quad(0), Quad(0), (1 - c / a) * omega_B.z * T});
  const auto error = [&](int steps) {
    State<Quad> state = start;
    for (int n = 0; n < steps; ++n) {
      TypeParam::step(body, state, T / steps, NoTorque{});
    }
    return angle_between(exact, state.q_IB);
  };
  EXPECT_NEAR(this->order(error(this->kFreeCoarse), error(2 * this->kFreeCoarse)),
              test::free_order<TypeParam>(), 0.15);
}

}  // namespace
}  // namespace adstar
