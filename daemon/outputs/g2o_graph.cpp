// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/g2o_graph.hpp"

#include <initializer_list>

#include "core/base/settings.hpp"

namespace swiftlet {
namespace {

void append_numbers(std::string& text, std::initializer_list<double> numbers) {
  for (const double number : numbers) text.append(" ").append(shortest_text(number));
}

void append_pose(std::string& text, const Pose2& pose) {
  append_numbers(text, {pose.x_m(), pose.y_m(), pose.yaw_rad()});
}

void append_edge(std::string& text, const RelativePoseFactor<KeyframeId>& factor) {
  const Eigen::Matrix3d W = factor.dcs_scale * factor.dcs_scale * factor.information;
  text += "EDGE_SE2 " + std::to_string(index_of(factor.from)) + " " + std::to_string(index_of(factor.to));
  append_pose(text, factor.T_from_to);
  append_numbers(text, {W(0, 0), W(0, 1), W(0, 2), W(1, 1), W(1, 2), W(2, 2)});
  text += "\n";
}

}  // namespace

std::string g2o_text(const PoseGraph& graph) {
  std::string text;
  for (const auto& [id, T_map_keyframe] : graph.T_map_keyframe) {
    text += "VERTEX_SE2 " + std::to_string(index_of(id));
    append_pose(text, T_map_keyframe);
    text += "\n";
  }
  if (!graph.T_map_keyframe.empty())
    text += "FIX " + std::to_string(index_of(graph.T_map_keyframe.first_id())) + "\n";
  for (const RelativePoseFactor<KeyframeId>& factor : graph.factors.values())
    if (!factor.information.isZero(0.0)) append_edge(text, factor);
  return text;
}

}  // namespace swiftlet
