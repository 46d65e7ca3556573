// A small SVG canvas: world coordinates in metres, y up, mapped to pixels.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace berm::run {

using Point2 = std::pair<double, double>;

// Words as the text of an element: names of files and machines may have any character.
std::string svg_escaped(const std::string& words);

class SvgPanel {
 public:
  // The world rectangle (x0, y0)..(x1, y1) is drawn at the pixel place (left, top), scale pixels per metre.
  SvgPanel(double x0, double y0, double x1, double y1, double left, double top, double scale);

  void rectangle(double x, double y, double width, double height, const std::string& style);
  void polygon(const std::vector<Point2>& points, const std::string& style);
  void line(const std::vector<Point2>& points, const std::string& style);
  void circle(double x, double y, double radius_m, const std::string& style);
  void text(double x, double y, const std::string& words, const std::string& style = "font-size:12px");
  void axes(double step_m, const std::string& x_name, const std::string& y_name);
  void title(const std::string& words);

  double pixel_width() const { return (x1_ - x0_) * scale_; }
  double pixel_height() const { return (y1_ - y0_) * scale_; }
  std::string body() const;  // what is drawn is clipped to the world rectangle; axes and title stand outside

 private:
  double px(double x) const { return left_ + (x - x0_) * scale_; }
  double py(double y) const { return top_ + (y1_ - y) * scale_; }
  double x0_, y0_, x1_, y1_, left_, top_, scale_;
  std::string body_, frame_;
};

// Writes the panels into one file, whole or not at all. Throws std::runtime_error naming the path.
void write_svg(const std::string& path, double width, double height, const std::vector<const SvgPanel*>& panels, const std::string& extra = {});

// Colour of a height between low and high (metres): dark green, ochre, white; "#rrggbb".
std::string height_colour(double height_m, double low_m, double high_m);

}  // namespace berm::run
