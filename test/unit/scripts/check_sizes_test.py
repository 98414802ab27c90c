#!/usr/bin/env python3
"""The check of the sizes finds long files, long functions of every kind and classes spread over files, and nothing else."""
import sys
import tempfile
import unittest
from pathlib import Path

LIB = Path(__file__).resolve().parents[3] / 'scripts' / 'lib'
sys.path.insert(0, str(LIB))
import check_sizes  # noqa: E402

CODE = '''#include "a.h"
#define OPEN {
namespace a {
namespace {
// a brace { in a comment
constexpr char kText[] = "}{";
const std::vector<int> kTable = {
    1, 2};
const auto kSquare = [](int x) { return x * x; };
enum class Kind { kOne, kTwo };
struct Plain : Base<int(int)> {
  int x{0};
  bool get() const { return x > 0; }
  Plain() : x{1} {}
};
}  // namespace
template <class T>
std::vector<T> Shape<T>::corners(const T& t,
                                 int n) const {
  if (n > 0) {
    run([&] { return t; });
  }
  for (const auto& [a, b] : map) {
  }
  return {};
}
Shape::Shape() : size_(0) {
  size_ = '{';
}
Shape::~Shape() {}
bool Shape::operator==(const Shape& other) const { return true; }
}  // namespace a
'''


class SizesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def check(self, **files):
        for name, text in files.items():
            (self.folder / name.replace('_cpp', '.cpp')).write_text(text)
        return list(check_sizes.check(sorted(self.folder.glob('*.cpp'))))

    def test_functions_and_their_lines(self):
        self.assertEqual(list(check_sizes.functions(CODE)),
                         [('kSquare', 9, 9), ('get', 13, 13), ('Plain', 14, 14), ('Shape<T>::corners', 17, 26), ('Shape::Shape', 27, 29),
                          ('Shape::~Shape', 30, 30), ('Shape::operator==', 31, 31)])

    def test_code_that_keeps_the_limits(self):
        self.assertEqual(self.check(a_cpp=CODE), [])

    def test_a_long_function(self):
        body = '  run();\n' * 58
        self.assertEqual(self.check(a_cpp=f'void A::go() {{\n{body}}}\n'), [])
        problem, = self.check(a_cpp=f'\nvoid A::go() {{\n{body}  run();\n}}\n')
        self.assertRegex(problem, r'a\.cpp:2: A::go\(\) has 61 lines')

    def test_a_long_constructor_inside_a_class(self):
        body = '    run();\n' * 60
        problem, = self.check(a_cpp=f'class A : public B {{\n public:\n  A() : x_(1) {{\n{body}  }}\n}};\n')
        self.assertRegex(problem, r'A\(\) has 62 lines')

    def test_a_long_constructor_with_members_in_braces(self):
        body = '  run();\n' * 60
        problem, = self.check(a_cpp=f'A::A(int a)\n    : a_{{a}}, b_(2), c_{{b(), {{1}}}} {{\n{body}}}\n')
        self.assertRegex(problem, r'A::A\(\) has 63 lines')

    def test_a_long_lambda_outside_of_a_function(self):
        body = '  run();\n' * 60
        problem, = self.check(a_cpp=f'const auto kRun = [](int x) {{\n{body}}};\n')
        self.assertRegex(problem, r'kRun\(\) has 62 lines')

    def test_a_long_file(self):
        self.assertEqual(self.check(a_cpp='int x;\n' * 350), [])
        problem, = self.check(a_cpp='int x;\n' * 351)
        self.assertRegex(problem, r'a\.cpp: 351 lines')

    def test_a_class_in_two_files(self):
        problem, = self.check(a_cpp='void A::go() {\n}\n', b_cpp='int A::stop() {\n}\n')
        self.assertRegex(problem, r'the member functions of A are in \S*a\.cpp, \S*b\.cpp')


if __name__ == '__main__':
    unittest.main()
