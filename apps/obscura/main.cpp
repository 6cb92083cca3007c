#include <cstdio>
int main() {
  std::puts("obscura");
  return 0;
}
