#include "report/tables/frontier_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "report/plots/frontier_plot.h"
#include "report/sample_record.h"
#include "report/tables/formats/csv_format.h"

namespace gnomon::report {
namespace {

/// A study of one light and view: entries of a method, its memory and wrong samples of a thousand.
struct Entry {
  std::string label, name;
  std::uint64_t tables, heights;
  double wrong;
};

study::StudyRecord recordOf(const std::vector<Entry>& entries) {
  study::StudyRecord record;
  for (const Entry& entry : entries) {
    record.methods.push_back({entry.label, entry.name, "", ""});
    study::ResultRecord result{entry.label, "one light", "one view", "all", {}};
    result.counts.samples = 1000;
    result.counts.truePositive = 400;
    result.counts.trueNegative = 600 - entry.wrong;
    result.counts.falsePositive = entry.wrong;
    record.results.push_back(result);
    study::CostRecord cost;
    cost.method = entry.label;
    cost.tableBytes = entry.tables;
    cost.heightBytes = entry.heights;
    record.cost.push_back(cost);
  }
  return record;
}

std::vector<FrontierPoint> byMemory(const std::vector<Entry>& entries) {
  return frontier(recordOf(entries), Price::memory);
}

TEST(Frontier, KeepsWhatNoSmallerTableBeats) {
  const auto points = byMemory({{"a 8", "a", 800, 0, 50},
                                {"a 16", "a", 1600, 0, 20},
                                {"b", "b", 800, 100, 60},
                                {"c", "c", 1600, 400, 20},
                                {"d", "d", 0, 400, 70}});
  ASSERT_EQ(points.size(), 5U);
  std::vector<std::string> efficient;
  for (const FrontierPoint& point : points) {
    if (point.efficient) efficient.push_back(point.label);
  }
  EXPECT_EQ(efficient, (std::vector<std::string>{"d", "a 8", "a 16"}));
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(),
                             [](const auto& p, const auto& q) { return p.price < q.price; }));
  EXPECT_DOUBLE_EQ(points.back().price, 2000);
  EXPECT_DOUBLE_EQ(points.front().errorRate, 0.07);
}

TEST(Frontier, OfEqualMemoryTheBetterOneIsEfficient) {
  const auto points =
      byMemory({{"a", "a", 800, 0, 50}, {"b", "b", 800, 0, 30}, {"a2", "a", 900, 0, 40}});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].label, "b");
  EXPECT_TRUE(points[0].efficient);
  EXPECT_FALSE(points[1].efficient);
  EXPECT_FALSE(points[2].efficient);
}

TEST(Frontier, IsEmptyWhereThereIsNothingToTrade) {
  EXPECT_TRUE(byMemory({{"a", "a", 800, 0, 50}, {"b", "b", 900, 0, 30}}).empty());
  EXPECT_TRUE(byMemory({}).empty());
  // Without tables there is no memory to draw.
  EXPECT_EQ(byMemory({{"n", "n", 0, 0, 9}, {"a", "a", 8, 0, 5}, {"a2", "a", 9, 0, 4}}).size(), 2U);
}

TEST(Frontier, LeavesOutWhatAnswersInFewerCases) {
  // "a 16" would win, but was asked only under one of two lights.
  study::StudyRecord record = recordOf({{"a 8", "a", 800, 0, 50}, {"a 16", "a", 1600, 0, 1}});
  record.methods.push_back({"a 32", "a", "", ""});
  record.cost.push_back({"a 32", 960, 3200, 0, std::nullopt});
  for (const char* light : {"one light", "other light"}) {
    record.results.push_back(record.results.front());
    record.results.back().method = "a 32";
    record.results.back().light = light;
  }
  record.results.push_back(record.results.front());
  record.results.back().light = "other light";
  const auto points = frontier(record, Price::memory);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].label, "a 8");
  EXPECT_EQ(points[1].label, "a 32");
}

TEST(Frontier, MayBeAskedForTheTimeOfAFrame) {
  study::StudyRecord record =
      recordOf({{"a 8", "a", 800, 0, 50}, {"a 16", "a", 800, 0, 20}, {"b", "b", 0, 0, 10}});
  EXPECT_TRUE(frontier(record, Price::frameTime).empty()) << "nothing was timed";
  record.cost[0].frameMs = 4;
  record.cost[1].frameMs = 3;
  EXPECT_EQ(frontier(record, Price::frameTime).size(), 2U);
  record.cost[2].frameMs = 9;
  const auto points = frontier(record, Price::frameTime);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].label, "a 16");
  EXPECT_EQ(points[0].price, 3);
  EXPECT_FALSE(points[1].efficient) << "slower and worse";
  EXPECT_TRUE(points[2].efficient) << "no table, and no memory";
  EXPECT_TRUE(frontier(record, Price::memory).empty()) << "of memory there is one choice";
  const MethodStyles styles(study::studyMeans(record));
  const PlotSheet sheet = frontierPlot(points, Price::frameTime, styles);
  EXPECT_EQ(sheet.name, "frontier_time");
  EXPECT_EQ(sheet.section, "cost");
  EXPECT_NE(svgOf(sheet).find("frame, ms"), std::string::npos);
}

TEST(Frontier, MayBeAskedForTheTexelsRead) {
  study::StudyRecord record = recordOf({{"a 8", "a", 800, 0, 50}, {"a 16", "a", 800, 0, 20}});
  record.cost[0].texels = 2.5;
  record.cost[1].texels = 9;
  const auto points = frontier(record, Price::texels);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].price, 2.5);
  const MethodStyles styles(study::studyMeans(record));
  const PlotSheet sheet = frontierPlot(points, Price::texels, styles);
  EXPECT_EQ(sheet.name, "frontier_texels");
  ASSERT_EQ(sheet.values.size(), 2U);
  EXPECT_EQ(sheet.values[0], "a 8: 5.00 % wrong, 2.5 texels");
}

TEST(Frontier, PlotAndRowsHoldEveryEntry) {
  const study::StudyRecord record =
      recordOf({{"a, 8", "a", 800, 0, 50}, {"a 16", "a", 1600, 0, 0}});
  const MethodStyles styles(study::studyMeans(record));
  const auto points = frontier(record, Price::memory);
  const std::string svg = svgOf(frontierPlot(points, Price::memory, styles));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_EQ(svg, svgOf(frontierPlot(points, Price::memory, styles)));
  EXPECT_EQ(csvTable(frontierTable(points)),
            "method,shader,bytes,error_rate,efficient\n\"a, 8\",a,800,0.05,1\na 16,a,1600,0,1\n");
}

}  // namespace
}  // namespace gnomon::report
