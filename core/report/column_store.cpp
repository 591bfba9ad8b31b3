#include "report/column_store.h"

#include <string>
#include <utility>

#include "base/clock.h"

namespace unshot {
namespace {

void operator+=(ColumnStore::Spent& a, const ColumnStore::Spent& b) {
  a.seconds += b.seconds;
  a.cpu_seconds += b.cpu_seconds;
}

}  // namespace

class ColumnStore::Method final : public FormFactorMethod {
 public:
  Method(ColumnStore& store, std::unique_ptr<FormFactorMethod> method)
      : store_(store), method_(std::move(method)) {}

  ReceiverKind receiverKind() const override { return method_->receiverKind(); }
  Column column(std::uint32_t q) override { return store_.column(*method_, q); }
  Column draft(std::uint32_t q, ColumnQuality wanted) override { return method_->draft(q, wanted); }
  Row row(std::uint32_t v) override { return method_->row(v); }
  std::uint64_t drawn() const override { return method_->drawn(); }
  std::string note() const override { return method_->note(); }

 private:
  ColumnStore& store_;
  std::unique_ptr<FormFactorMethod> method_;
};

std::unique_ptr<FormFactorMethod> ColumnStore::wrap(std::unique_ptr<FormFactorMethod> method) {
  charged_ = spent_ = {};
  return std::make_unique<Method>(*this, std::move(method));
}

Column ColumnStore::column(FormFactorMethod& method, std::uint32_t q) {
  if (q >= entries_.size()) entries_.resize(q + 1);
  Entry& entry = entries_[q];
  if (entry.column && entry.round == round_) {
    charged_ += entry.cost;
    spent_ += entry.cost;
    return *entry.column;
  }
  const double wall = wallSeconds(), cpu = cpuSeconds();
  Column column = method.column(q);
  entry.cost = {wallSeconds() - wall, cpuSeconds() - cpu};
  spent_ += entry.cost;
  entry.round = round_;
  if (!entry.column && bytes_ + column.bytes() <= budget_) {
    entry.column = std::make_unique<Column>(column);
    bytes_ += column.bytes();
  }
  full_ = full_ || !entry.column;
  return column;
}

}  // namespace unshot
