// The report as one page of HTML that stands for itself: style, plots and pictures are in it.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "report/curve_record.h"

namespace unshot {

/// Pictures of every mode at equal costs.
struct PictureTable {
  struct Cell {
    std::string png;  ///< bytes; empty: none
    std::string caption;
  };
  struct Row {
    std::string mode;
    std::vector<Cell> cells;  ///< one per column
  };
  std::string title, text;
  std::vector<std::string> columns;
  std::vector<Row> rows;
};

struct PageScene {
  const CurveRecord* record = nullptr;
  std::map<std::string, std::string> svg;  ///< plots by name, as far as they were drawn
  std::string picture;                     ///< PNG of the solution; empty: none
  std::vector<PictureTable> pictures;
};

struct PageTexts {
  std::string machine;  ///< what it was measured on
  std::string command;  ///< that made the report
};

std::string pageHtml(std::span<const PageScene> scenes, const PageTexts& texts);

/// In words, which modes are first per row and per second, and why, as far as the figures show it.
std::vector<std::string> whoWins(const CurveRecord& record);

}  // namespace unshot
