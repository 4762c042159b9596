#include "service/scene/body_keys.hpp"

#include <algorithm>
#include <array>

#include "service/scene/facet_keys.hpp"
#include "service/scene/fleet.hpp"
#include "service/scene/inertia.hpp"
#include "service/scene/joint_keys.hpp"

namespace adstar::scene {
namespace {

using multibody::BodySpec;
using multibody::JointStart;

constexpr std::string_view kHub = "hub";
constexpr std::int64_t kMostBodies = 1000;
constexpr std::string_view kPoint = "[0.5, 0.0, 0.0]";

double read_mass(Keys& keys) {
  const Want mass{"a mass above 0 kg", "5.0"};
  return read_positive(keys.required("mass_kg", mass), mass).value_or(1);
}

std::optional<Eigen::Matrix3d> read_body_inertia(Keys& keys) {
  const Want want{"3 principal moments or a 3x3 tensor in kg m^2, about its own centre of mass",
                  "[0.2, 0.1, 0.3]"};
  const Value value = keys.required("inertia_body_kg_m2", want);
  const auto inertia = read_inertia(value);
  if (!inertia) {
    return std::nullopt;
  }
  if (inertia->principal.drawn) {
    value.refuse("numbers: bodies of a spacecraft are not drawn", want.example);
    return std::nullopt;
  }
  Draws none(0, 0);
  return inertia->value(none);
}

class LinkedReader {
 public:
  explicit LinkedReader(LinkedPlan& plan) : plan_(plan) {}

  void read_body(const Value& value) {
    Keys keys(value, "[[spacecraft.body]] blocks");
    const Value name_value = keys.required("name", {kNameRule, "\"panel\""});
    const auto name = read_name(name_value, "\"panel\"");
    const double mass = read_mass(keys);
    const auto inertia = read_body_inertia(keys);
    const Facets<double> outside = read_facets(keys);
    keys.refuse_unknown();
    if (name && inertia) {
      add_body(name_value, *name, mass, *inertia, outside);
    }
  }

  void read_joint(const Value& value) {
    Keys keys(value, "[[spacecraft.joint]] blocks");
    const Value name_value = keys.required("name", {kNameRule, "\"hinge\""});
    const auto name = read_name(name_value, "\"hinge\"");
    const int from = read_end(keys, "from"), to = read_end(keys, "to");
    auto read = read_joint_keys(keys);
    keys.refuse_unknown();
    if (!name || !read || from < 0 || to < 0) {
      return;
    }
    if (from == to) {
      value.refuse_as("a joint of " +
                          in_quotes(plan_.linked.bodies[static_cast<std::size_t>(from)].name) +
                          " with itself",
                      "two bodies", "another name in from or to");
      return;
    }
    add_joint(name_value, *name, from, to, std::move(*read));
  }

  /// Links one after the other, alike, the first hung on `from`.
  void read_chain(const Value& value) {
    Keys keys(value, "[[spacecraft.chain]] blocks");
    const Value count_value = keys.required("count", {"how many links", "100"});
    const auto count =
        read_integer(count_value, {1, kMostBodies}, {"an integer from 1 to 1000", "100"});
    const Value name_value = keys.required("name", {kNameRule, "\"link{}\""});
    const auto pattern = read_name_pattern(name_value, count.value_or(1));
    const int from = read_end(keys, "from");
    const Value first_value = keys.optional("first_point_from_body_m");
    const auto first = read_vector(first_value, kPoint);
    const double mass = read_mass(keys);
    const auto inertia = read_body_inertia(keys);
    const Facets<double> outside = read_facets(keys);
    const auto read = read_joint_keys(keys);
    keys.refuse_unknown();
    if (!count || !pattern || from < 0 || !inertia || !read) {
      return;
    }
    int last = from;
    for (std::int64_t i = 0; i < *count; ++i) {
      const std::string name = pattern->name(static_cast<std::uint64_t>(i));
      const int body = add_body(name_value, name, mass, *inertia, outside);
      if (body < 0) {
        return;
      }
      JointRead link = *read;
      if (i == 0 && first) {
        link.joint.a.point_B = *first;
      }
      add_joint(name_value, name, last, body, std::move(link));
      last = body;
    }
  }

  /// A joint that closes a loop stands where the others of the loop put it.
  void refuse_starts_in_loops() const {
    const auto& joints = plan_.linked.joints;
    for (const int loop : multibody::find_topology(plan_.linked.bodies.size(), joints).loops) {
      const auto j = static_cast<std::size_t>(loop);
      for (const Value& value : {begun_[j].coordinate, begun_[j].rate}) {
        if (value) {
          value.refuse_as(
              "a start of joint " + in_quotes(joints[j].name) + ", which closes a loop",
              "a start of the other joints of the loop, which say where this one stands",
              "removing it");
        }
      }
    }
  }

 private:
  int place_of(std::string_view name) const {
    const auto& bodies = plan_.linked.bodies;
    const auto found = std::find_if(bodies.begin(), bodies.end(),
                                    [&](const auto& body) { return body.name == name; });
    return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
  }

  int read_end(Keys& keys, std::string_view key) {
    const Want want{"the name of a body, or hub", "\"hub\""};
    const Value value = keys.required(key, want);
    const auto name = read_text(value, want);
    if (!name) {
      return -1;
    }
    const int place = place_of(*name);
    if (place < 0) {
      value.refuse("the name of a body of this spacecraft, or hub", "\"hub\"");
    }
    return place;
  }

  int add_body(const Value& where, const std::string& name, double mass,
               const Eigen::Matrix3d& inertia, const Facets<double>& outside) {
    if (place_of(name) >= 0 || name == "ground") {
      where.refuse_as(in_quotes(name) + " again", "a name of its own for each body; the hub is hub",
                      in_quotes(name + "2"));
      return -1;
    }
    if (plan_.linked.bodies.size() > static_cast<std::size_t>(kMostBodies)) {
      where.refuse_as("more than 1000 bodies", "at most 1000 bodies beside the hub",
                      "fewer of them");
      return -1;
    }
    BodySpec<double> body;
    body.name = name;
    body.mass_kg = mass;
    body.inertia_B = inertia;
    plan_.linked.bodies.push_back(std::move(body));
    plan_.outsides.push_back(outside);
    return static_cast<int>(plan_.linked.bodies.size()) - 1;
  }

  void add_joint(const Value& where, const std::string& name, int from, int to, JointRead read) {
    const auto& joints = plan_.linked.joints;
    if (std::any_of(joints.begin(), joints.end(), [&](const auto& j) { return j.name == name; })) {
      where.refuse_as(in_quotes(name) + " again", "a name of its own for each joint",
                      in_quotes(name + "2"));
      return;
    }
    read.joint.name = name;
    read.joint.body_a = from;
    read.joint.body_b = to;
    const std::size_t joint = joints.size();
    for (std::size_t k = 0; k < read.standing.size(); ++k) {
      multibody::CoordinateMotor<double> motor;
      motor.joint = joint;
      motor.coordinate = k;
      motor.standing = read.standing[k];
      if (read.commanded) {
        add_actuator(where, read.standing.size() == 1 ? name : name + "." + std::to_string(k + 1),
                     read.limit);
      }
      plan_.linked.motors.push_back(motor);
    }
    plan_.linked.joints.push_back(std::move(read.joint));
    plan_.linked.start_coordinates.push_back(read.start.q);
    plan_.starts.push_back(read.start);
    plan_.joint_values.push_back(where);
    begun_.push_back({read.coordinate, read.rate});
  }

  void add_actuator(const Value& where, const std::string& name, double limit) {
    const auto& all = plan_.actuators;
    if (std::any_of(all.begin(), all.end(), [&](const auto& a) { return a.name == name; })) {
      where.refuse_as("a motor called " + in_quotes(name) + " again",
                      "a name of its own for each motor; of a joint with several they are NAME.1, "
                      "NAME.2, ...",
                      "another name for one of the joints");
    }
    plan_.actuators.push_back(
        {name, ActuatorKind::joint, plan_.linked.motors.size(), {limit, 0, 0}});
  }

  struct Begun {
    Value coordinate, rate;
  };

  LinkedPlan& plan_;
  std::vector<Begun> begun_;  ///< by joint
};

template <class Each>
void for_each_block(const Value& value, std::string_view remedy, const Each& each) {
  if (!value) {
    return;
  }
  if (!value.is(Node::Kind::array)) {
    value.refuse("an array of tables", remedy);
    return;
  }
  if (value.node().items.size() > static_cast<std::size_t>(kMostBodies)) {
    value.refuse("at most 1000 of them", "fewer of them");
    return;
  }
  for (std::size_t i = 0; i < value.node().items.size(); ++i) {
    each(value.item(i));
  }
}

/// An empty list is none.
bool names_some(const Value& value) {
  return value && !(value.is(Node::Kind::array) && value.node().items.empty());
}

}  // namespace

std::unique_ptr<LinkedPlan> read_linked(Keys& spacecraft, const Facets<double>& outside) {
  const Value bodies = spacecraft.optional("body"), joints = spacecraft.optional("joint"),
              chains = spacecraft.optional("chain"), mass = spacecraft.optional("mass_kg"),
              linking = spacecraft.optional("formulation");
  if (!names_some(bodies) && !names_some(joints) && !names_some(chains)) {
    for (const Value& value : {mass, linking}) {
      if (value) {
        value.refuse_as("a key of linked bodies without any", "[[spacecraft.body]] beside it",
                        "removing it");
      }
    }
    return nullptr;
  }
  auto plan = std::make_unique<LinkedPlan>();
  plan->where = bodies ? bodies : chains ? chains : joints;
  const Want hub_mass{"the mass of the hub above 0 kg, beside [[spacecraft.body]]", "100.0"};
  if (!mass) {
    spacecraft.miss("mass_kg", hub_mass);
  }
  constexpr std::array<std::string_view, 2> kFormulations{"se3", "direct_product"};
  plan->linked.formulation =
      static_cast<multibody::Formulation>(read_choice(linking, kFormulations).value_or(0));
  BodySpec<double> hub;
  hub.name = kHub;
  hub.mass_kg = read_positive(mass, hub_mass).value_or(1);
  plan->linked.bodies.push_back(hub);
  plan->outsides.push_back(outside);
  LinkedReader reader(*plan);
  for_each_block(bodies, "[[spacecraft.body]], in double brackets",
                 [&](const Value& value) { reader.read_body(value); });
  for_each_block(chains, "[[spacecraft.chain]], in double brackets",
                 [&](const Value& value) { reader.read_chain(value); });
  for_each_block(joints, "[[spacecraft.joint]], in double brackets",
                 [&](const Value& value) { reader.read_joint(value); });
  reader.refuse_starts_in_loops();
  return plan;
}

Vec3<double> momentum_of(const LinkedBodies& linked) {
  const multibody::Assembly<double> assembly(linked.bodies, linked.joints,
                                             {linked.formulation, {}});
  return multibody::total_momentum(assembly, multibody::make_state(assembly)).H_I.value();
}

std::shared_ptr<const LinkedBodies> place_linked(const LinkedPlan& plan,
                                                 const Eigen::Matrix3d& inertia_B,
                                                 const Quat<double>& q_IB,
                                                 const Vec3<double>& omega_B) {
  auto placed = std::make_shared<LinkedBodies>(plan.linked);
  BodySpec<double>& hub = placed->bodies.front();
  hub.inertia_B = inertia_B;
  hub.q_IB = normalised(q_IB);
  hub.omega_B = omega_B;
  try {
    multibody::place(placed->bodies, placed->joints,
                     std::span<const JointStart<double>>(plan.starts));
    multibody::centre(placed->bodies);
    const multibody::Assembly<double> assembly(placed->bodies, placed->joints,
                                               {placed->formulation, {}});
    return placed;
  } catch (const multibody::JointApart& error) {
    plan.joint_values[error.joint].refuse_as(
        error.defect, "joints that close: this one stands where the others of its loop put it",
        "the coordinate, rate or points of the others");
    return nullptr;
  } catch (const std::invalid_argument& error) {
    plan.where.refuse_as(error.what(), "bodies and joints that fit together", "correcting that");
    return nullptr;
  }
}

}  // namespace adstar::scene
