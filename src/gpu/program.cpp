#include "gpu/program.h"

#include <cassert>
#include <utility>

namespace obscura::gpu {

int Program::add_table(std::span<const float> values) {
  if (table_region < 0) table_region = add_region(0);
  const auto start = static_cast<int>(tables.size());
  tables.insert(tables.end(), values.begin(), values.end());
  regions[static_cast<std::size_t>(table_region)] = tables.size() * sizeof(float);
  return start;
}

void Program::add(Pass pass) {
  assert(check(pass).ok());
  pass.half = half;
  passes.push_back(std::move(pass));
}

}  // namespace obscura::gpu
