#!/usr/bin/env python3
"""The check of constants finds those without origin, and no others."""

import unittest

from check_constants import constants_without_origin


class CheckConstants(unittest.TestCase):
    def expect(self, text, *lines):
        self.assertEqual([number for number, _ in constants_without_origin(text)], list(lines))

    def test_comment_behind(self):
        self.expect("constexpr int kA = 1;  // chosen: one is enough\nconstexpr int kB = 2;  // metres\n", 2)

    def test_comment_above_is_of_all_that_follow(self):
        self.expect("// Measured on two\n// scans.\nconstexpr int kA = 1;\nstatic constexpr double kB = 2;\n")

    def test_group_ends(self):
        self.expect("// Chosen.\nconstexpr int kA = 1;\n\nconstexpr int kB = 2;\n", 4)
        self.expect("// Chosen.\nconstexpr int kA = 1;\n// Metres.\nconstexpr int kB = 2;\n", 4)
        self.expect("// Chosen.\nint x = 0;\nconstexpr int kB = 2;\n", 3)

    def test_source(self):
        self.expect("// Huang et al. 2013.\nconstexpr double kA = 1;\n/// CurveFusion 4.1.\ninline constexpr int kB = 30;\n")

    def test_computed(self):
        self.expect("constexpr double kA = 2 * kB;\nconstexpr size_t kC = sizeof(float);\n")
        self.expect("constexpr double kA = 2 * kMillimetre;\n", 1)

    def test_declaration_of_several_lines(self):
        self.expect("constexpr std::array<int, 2> kA = {\n    1,\n    2};\nconstexpr int kB = 2;\n", 1, 4)
        self.expect("// Derived.\nconstexpr std::array<int, 2> kA = {\n    1,\n    2};\nconstexpr int kB = 2;\n")

    def test_what_is_no_constant(self):
        self.expect("constexpr bool IsEven(int i) { return i % 2 == 0; }\nint kind = 3;\n")


if __name__ == "__main__":
    unittest.main()
