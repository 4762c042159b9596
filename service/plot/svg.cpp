#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "service/plot/escape.hpp"
#include "service/plot/plot.hpp"
#include "service/plot/ticks.hpp"

namespace adstar::plot {
namespace {

constexpr double kWidth = 960, kPanelHeight = 430, kTitleHeight = 40;
constexpr double kLeft = 92, kRight = 250, kTop = 40, kBottom = 62;  // around the axes of a panel

/// Eight colours that people with any colour vision can tell apart (Okabe and Ito 2008), black
/// first.
constexpr std::array<const char*, 8> kColours = {"#000000", "#e69f00", "#56b4e9", "#009e73",
                                                 "#b8a800", "#0072b2", "#d55e00", "#cc79a7"};

struct Style {
  std::size_t number = 0;
  const char* colour() const { return kColours[number % kColours.size()]; }
  std::size_t shape() const { return (number / kColours.size() + number) % 4; }
};

using Styles = std::map<std::string, Style>;

Styles styles_of(const std::vector<Panel>& panels) {
  Styles styles;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      styles.try_emplace(series.name, Style{styles.size()});
    }
  }
  return styles;
}

std::string mark(const Style& style, double x, double y) {
  constexpr double r = 3.6;
  switch (style.shape()) {
    case 0:
      return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}"/>)", x, y, r,
                         style.colour());
    case 1:
      return fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{}" height="{}" fill="{}"/>)", x - r,
                         y - r, 2 * r, 2 * r, style.colour());
    case 2:
      return fmt::format(R"(<path d="M{:.1f} {:.1f}l{} {}h-{}z" fill="{}"/>)", x, y - 1.2 * r,
                         1.2 * r, 2.2 * r, 2.4 * r, style.colour());
    default:
      return fmt::format(R"(<path d="M{:.1f} {:.1f}l{} {}l-{} {}l-{} -{}z" fill="{}"/>)", x,
                         y - 1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r,
                         style.colour());
  }
}

bool shows(const Axis& axis, double value) {
  return std::isfinite(value) && (axis.scale == Scale::linear || value > 0);
}

/// The point as the panel shows it; none when it cannot.
std::optional<Point> shown(const Panel& panel, Point point) {
  if (panel.least_y > 0 && point.y < panel.least_y) {
    point.y = panel.least_y;
  }
  return shows(panel.x, point.x) && shows(panel.y, point.y) ? std::optional(point) : std::nullopt;
}

Range range_of(const Panel& panel, double Point::*coordinate) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series& series : panel.series) {
    for (const Point& raw : series.points) {
      if (const auto point = shown(panel, raw)) {
        range.least = std::min(range.least, (*point).*coordinate);
        range.most = std::max(range.most, (*point).*coordinate);
      }
    }
  }
  return range.least <= range.most ? range : Range{0.1, 1};
}

/// A value to its place between `from` and `to` on the page.
double place(Scale scale, const Range& range, double value, double from, double to) {
  const double part = scale == Scale::log
                          ? std::log10(value / range.least) / std::log10(range.most / range.least)
                          : (value - range.least) / (range.most - range.least);
  return from + part * (to - from);
}

class Drawing {
 public:
  Drawing(const Panel& panel, const Styles& styles, double top)
      : panel_(panel),
        styles_(styles),
        top_(top + kTop),
        bottom_(top + kPanelHeight - kBottom),
        x_(rule(panel.x.scale, range_of(panel, &Point::x), 10)),
        y_(rule(panel.y.scale, range_of(panel, &Point::y), 9)) {}

  std::string text() const { return frame() + lines() + legend(); }

 private:
  static constexpr double kFar = kWidth - kRight;

  double x(double value) const { return place(panel_.x.scale, x_.range, value, kLeft, kFar); }
  double y(double value) const { return place(panel_.y.scale, y_.range, value, bottom_, top_); }

  std::string frame() const {
    std::string text = fmt::format(R"(<text x="{}" y="{}" font-size="15">{}</text>)"
                                   "\n",
                                   kLeft, top_ - 12, escaped(panel_.title));
    for (const Tick& tick : x_.ticks) {
      text += fmt::format(
          R"(<path d="M{0:.1f} {1}V{2}" stroke="#ddd"/><text x="{0:.1f}" y="{3}" text-anchor="middle">{4}</text>)"
          "\n",
          x(tick.at), top_, bottom_, bottom_ + 18, tick.label);
    }
    for (const Tick& tick : y_.ticks) {
      text += fmt::format(
          R"(<path d="M{0} {1:.1f}H{2}" stroke="#ddd"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)"
          "\n",
          kLeft, y(tick.at), kFar, kLeft - 8, y(tick.at) + 4, tick.label);
    }
    text += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#444"/>)"
                        "\n",
                        kLeft, top_, kFar - kLeft, bottom_ - top_);
    text += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)"
                        "\n",
                        (kLeft + kFar) / 2, bottom_ + 42, escaped(panel_.x.label));
    const double middle = (top_ + bottom_) / 2;
    text += fmt::format(
        R"svg(<text x="22" y="{0}" text-anchor="middle" transform="rotate(-90 22 {0})">{1}</text>)svg"
        "\n",
        middle, escaped(panel_.y.label));
    return text;
  }

  std::string lines() const {
    std::string text;
    for (const Series& series : panel_.series) {
      const Style& style = styles_.at(series.name);
      std::string path, marks;
      bool joined = false;
      for (const Point& raw : series.points) {
        const auto point = shown(panel_, raw);
        if (point) {
          path += fmt::format("{}{:.1f} {:.1f}", joined ? "L" : "M", x(point->x), y(point->y));
          marks += series.marks ? mark(style, x(point->x), y(point->y)) : "";
        }
        joined = point.has_value();
      }
      text += fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.4"/>{})"
                          "\n",
                          path, style.colour(), marks);
    }
    return text;
  }

  std::string legend() const {
    std::string text;
    std::vector<std::string> named;
    for (const Series& series : panel_.series) {
      if (std::find(named.begin(), named.end(), series.name) != named.end()) {
        continue;
      }
      const Style& style = styles_.at(series.name);
      const double at = top_ + 8 + 17 * static_cast<double>(named.size());
      named.push_back(series.name);
      text += fmt::format(
          R"(<path d="M{} {}h24" stroke="{}" stroke-width="1.4"/>{}<text x="{}" y="{}">{}</text>)"
          "\n",
          kFar + 14, at, style.colour(), series.marks ? mark(style, kFar + 26, at) : "", kFar + 46,
          at + 4, escaped(series.name));
    }
    return text;
  }

  const Panel& panel_;
  const Styles& styles_;
  double top_, bottom_;
  Ruling x_, y_;
};

}  // namespace

std::string svg(const std::string& title, const std::vector<Panel>& panels) {
  const double height = kTitleHeight + kPanelHeight * static_cast<double>(panels.size());
  std::string text = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
      R"(font-family="sans-serif" font-size="12">)"
      "\n"
      R"(<rect width="100%" height="100%" fill="#fff"/>)"
      "\n"
      R"(<text x="{2}" y="28" font-size="18">{3}</text>)"
      "\n",
      kWidth, height, kLeft, escaped(title));
  const Styles styles = styles_of(panels);
  double top = kTitleHeight;
  for (const Panel& panel : panels) {
    text += Drawing(panel, styles, top).text();
    top += kPanelHeight;
  }
  return text + "</svg>\n";
}

}  // namespace adstar::plot
