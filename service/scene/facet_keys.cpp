#include "service/scene/facet_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace adstar::scene {
namespace {

constexpr std::size_t kMostFacets = 64;

/// What a surface is like, whatever its shape.
Facet<double> read_surface(Keys& keys) {
  Facet<double> like;
  like.drag_coefficient = read_number(keys.optional("drag_coefficient"), NumberRange{0.0, 10.0},
                                      {"a drag coefficient from 0 to 10", "2.2"})
                              .value_or(like.drag_coefficient);
  const Want part{"a part from 0 to 1 of the light", "0.3"};
  like.specular =
      read_number(keys.optional("specular_reflectivity"), NumberRange{0.0, 1.0}, part).value_or(0);
  const Value diffuse = keys.optional("diffuse_reflectivity");
  like.diffuse = read_number(diffuse, NumberRange{0.0, 1.0}, part).value_or(0);
  if (like.specular + like.diffuse > 1) {
    diffuse.refuse("no more than what specular_reflectivity leaves of 1",
                   number_text(1 - like.specular));
  }
  return like;
}

std::vector<Facet<double>> read_box(const Value& value) {
  constexpr std::string_view kSize = "[1.0, 1.0, 2.0]";
  Keys keys(value, "box = { size_m = [1.0, 1.0, 2.0] }");
  const Value size_value = keys.required("size_m", {"3 lengths along the body axes", kSize});
  const auto size = read_vector(size_value, kSize);
  if (size && !(size->x > 0 && size->y > 0 && size->z > 0)) {
    size_value.refuse("3 lengths above 0 m", kSize);
  }
  const Vec3<double> centre =
      read_vector(keys.optional("centre_body_m"), "[0.0, 0.0, 0.1]").value_or(Vec3<double>{});
  const Facet<double> like = read_surface(keys);
  keys.refuse_unknown();
  return size ? box_facets(*size, centre, like) : std::vector<Facet<double>>{};
}

Facet<double> read_facet(const Value& value) {
  constexpr std::string_view kNormal = "[1.0, 0.0, 0.0]", kCentre = "[0.5, 0.0, 0.0]";
  Keys keys(value,
            "facet = [ { area_m2 = 1.0, normal_body = [1.0, 0.0, 0.0], centre_body_m = [0.5, 0.0, "
            "0.0] } ]");
  const Want area{"an area above 0 m^2", "1.5"};
  const double area_m2 = read_positive(keys.required("area_m2", area), area).value_or(1);
  const Value normal_value =
      keys.required("normal_body", {"3 numbers: the direction outwards", kNormal});
  const auto normal = read_vector(normal_value, kNormal);
  const auto centre = read_vector(
      keys.required("centre_body_m", {"3 numbers: from the centre of mass", kCentre}), kCentre);
  Facet<double> facet = read_surface(keys);
  keys.refuse_unknown();
  facet.area_m2 = area_m2;
  facet.centre_B_m = centre.value_or(Vec3<double>{});
  if (normal) {
    const double largest =
        std::max({std::fabs(normal->x), std::fabs(normal->y), std::fabs(normal->z)});
    if (largest == 0) {
      normal_value.refuse("a direction, not all zeros", kNormal);
    } else {
      const Vec3<double> n = (1 / largest) * *normal;
      facet.normal_B = (1 / norm(n)) * n;
    }
  }
  return facet;
}

}  // namespace

Facets<double> read_facets(Keys& spacecraft) {
  std::vector<Facet<double>> facets;
  const Value box = spacecraft.optional("box");
  if (box) {
    facets = read_box(box);
  }
  const Value plates = spacecraft.optional("facet");
  if (plates && !plates.is(Node::Kind::array)) {
    plates.refuse("an array of tables",
                  "facet = [ { area_m2 = 1.0, ... } ], or in double brackets");
  } else if (plates) {
    const std::size_t count = plates.node().items.size();
    if (count > kMostFacets) {
      plates.refuse("at most 64 facets", "fewer of them");
    }
    for (std::size_t i = 0; i < std::min(count, kMostFacets); ++i) {
      facets.push_back(read_facet(plates.item(i)));
    }
  }
  return box || plates ? make_facets(std::move(facets)) : nullptr;
}

}  // namespace adstar::scene
