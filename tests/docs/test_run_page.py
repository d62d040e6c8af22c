#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What run_page.py must find on a page, and what it must let pass.
usage: test_run_page.py <prefix>"""

import pathlib
import sys
import unittest

import run_page

PREFIX = pathlib.Path(sys.argv.pop()).resolve()
GOOD = """# A page

```c hello.c
#include <pnpbs/pnpbs.h>
#include <stdio.h>

int main(void) {
  printf("%s\\n", pnpbs_status_string(PNPBS_OK));
  return 0;
}
```

Then

```sh
cc hello.c $(pkg-config --cflags --libs pnpbs) -o hello
./hello
```

```text
done
```

```sh
exit 1 # not run: no output is behind it
```
"""


class Pages(unittest.TestCase):
    def wrong(self, old="", new=""):
        self.assertIn(old, GOOD)
        return "\n".join(run_page.run_page(PREFIX, GOOD.replace(old, new, 1)))

    def test_good(self):
        self.assertEqual(self.wrong(), "")

    def test_other_output(self):
        self.assertIn("expected\nwell done\nprinted\ndone", self.wrong("\ndone\n", "\nwell done\n"))

    def test_output_too_short(self):
        self.assertIn("expected\nprinted\ndone", self.wrong("\ndone\n", "\n"))

    def test_failing_command(self):
        self.assertIn("exit code 3", self.wrong("./hello\n", "./hello\nexit 3\n"))

    def test_failing_command_in_between(self):
        self.assertIn("exit code 1", self.wrong("./hello\n", "false\n./hello\n"))

    def test_warning_of_the_compiler(self):
        self.assertIn("unused variable", self.wrong("{\n  printf", "{\n  int i;\n  printf"))

    def test_program_that_is_not_run(self):
        self.assertIn("no command that is run uses other.c", self.wrong("hello.c\n#", "other.c\n#"))

    def test_program_without_a_name(self):
        self.assertIn("without the name of a file", self.wrong("```c hello.c", "```c"))

    def test_nothing_to_run(self):
        self.assertIn("nothing on this page is run", self.wrong("```text", "as follows\n\n```text"))

    def test_library_that_the_loader_does_not_find(self):
        self.assertIn("libpnpbs.so", self.wrong("--libs pnpbs)", "--libs-only-L --libs-only-l pnpbs)"))

    @unittest.skipUnless(run_page.compiler("julia"), "there is no Julia")
    def test_julia_as_its_users_start_it(self):
        page = ("```julia a.jl\nprintln(Base.JLOptions().opt_level, Base.JLOptions().use_compiled_modules)"
                "\n```\n\n```sh\njulia a.jl\n```\n\n```text\n21\n```\n")
        self.assertEqual("\n".join(run_page.run_page(PREFIX, page)), "")

    def test_block_without_end(self):
        with self.assertRaisesRegex(ValueError, "has no end"):
            self.wrong("is behind it\n```", "is behind it\n")


unittest.main()
