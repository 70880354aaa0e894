// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "daemon/outputs/g2o_graph.hpp"

#include <gtest/gtest.h>

namespace swiftlet {
namespace {

RelativePoseFactor<KeyframeId> motion(std::uint32_t from, std::uint32_t to) {
  RelativePoseFactor<KeyframeId> factor;
  factor.from = make_id<KeyframeId>(from);
  factor.to = make_id<KeyframeId>(to);
  factor.T_from_to = Pose2(1.0, 0.25, 0.5);
  factor.information << 4.0, 0.5, 0.25, 0.5, 8.0, 0.125, 0.25, 0.125, 16.0;
  return factor;
}

TEST(G2oGraph, HasVerticesAFixedOneAndEdgesWithTheUpperTriangleOfTheirInformation) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2());
  graph.T_map_keyframe.push_back(Pose2(1.5, -2.0, 0.5));
  graph.factors.push_back(motion(0, 1));
  EXPECT_EQ(g2o_text(graph),
            "VERTEX_SE2 0 0 0 0\n"
            "VERTEX_SE2 1 1.5 -2 0.5\n"
            "FIX 0\n"
            "EDGE_SE2 0 1 1 0.25 0.5 4 0.5 0.25 8 0.125 16\n");
}

TEST(G2oGraph, WeightsClosuresAsTheRunDidAndLeavesOutDroppedOnes) {
  PoseGraph graph;
  graph.T_map_keyframe.push_back(Pose2());
  graph.T_map_keyframe.push_back(Pose2());
  RelativePoseFactor<KeyframeId> dropped = motion(0, 1);
  dropped.information.setZero();
  graph.factors.push_back(dropped);
  RelativePoseFactor<KeyframeId> doubted = motion(0, 1);
  doubted.dcs_scale = 0.5;
  graph.factors.push_back(doubted);
  EXPECT_EQ(g2o_text(graph),
            "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\nFIX 0\n"
            "EDGE_SE2 0 1 1 0.25 0.5 1 0.125 0.0625 2 0.03125 4\n");
}

TEST(G2oGraph, OfAnEmptyGraphIsEmpty) { EXPECT_EQ(g2o_text(PoseGraph()), ""); }

}  // namespace
}  // namespace swiftlet
