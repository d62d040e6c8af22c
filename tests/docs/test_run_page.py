#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What run_page.py must find on a page, and what it must let pass.
usage: test_run_page.py <prefix>"""

import pathlib
import sys
import unittest

import run_page
from figures import Outputs

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

    def test_a_page_of_which_nothing_can_be_run_here(self):
        page = "```fortran a.f90\nend\n```\n\n```sh\ngfortran a.f90\n```\n\n```text\n```\n"
        compiler, run_page.compiler = run_page.compiler, lambda name: None
        inherited = run_page.os.environ["PATH"]
        self.addCleanup(setattr, run_page, "compiler", compiler)
        self.addCleanup(run_page.os.environ.__setitem__, "PATH", inherited)
        run_page.os.environ["PATH"] = "/nowhere"
        self.assertIsNone(run_page.run_page(PREFIX, page))

    def test_block_without_end(self):
        with self.assertRaisesRegex(ValueError, "has no end"):
            self.wrong("is behind it\n```", "is behind it\n")


class Figures(unittest.TestCase):
    SAME = ("nodes 2996 of which boundary 200", "nodes 3100 of which boundary 191",
            "nearest over d: 0.98 +- 0.03", "nearest over d: 0.95 +- 0.03",
            '  "hash": "6cef293e90ce4c36",', '  "hash": "0123456789012345",',
            "at (0.5, -0.5), 1e-06 off", "at (0.51, -0.51), 1.02e-06 off",
            "0,0,0,1,0.19142135623730955", "0,0,0,1,0.19142135623730961")
    OTHER = ("nodes 2996 of which boundary 200", "nodes 3600 of which boundary 200",  # 20 % off
             "nodes 2996 of which boundary 200", "nodes 2396 of which boundary 200",
             "nodes 2996 of which boundary 200", "nodes 2996 of which boundary 240",
             "nodes 2996", "nodes 2996.0", "nodes 2996", "nodes -2996", "nodes 2996", "nodes 2996 ",
             "round 3", "round 4", "50 rows", "51 rows", "exit code 2", "exit code 3",
             "nodes 80, d 0.5", "nodes 80, d 0.6", "nodes 80, d 0.5", "nodes 80, d 0.4",
             "off by 0.0", "off by 0.001", "d = 1e-06", "d = 1e-05", "done", "Done", "1.00", "nan",
             "version 0.2.10", "version 0.2.11", "a100", "a101", "EPSG:2180", "EPSG2180",
             "hash 6cef293e90ce4c36", "hash 6cef293e90ce4c3", "hash 6cef293e90ce4c36", "hash 80", "one\n", "one\ntwo\n", "one\n", "")

    def test_what_may_differ_and_what_may_not(self):
        for wanted, found in zip(self.SAME[::2], self.SAME[1::2]):
            self.assertIsNone(Outputs().differ(wanted, found), found)
            self.assertIsNone(Outputs().differ(wanted, wanted), wanted)
        for wanted, found in zip(self.OTHER[::2], self.OTHER[1::2]):
            self.assertIn("printed", Outputs().differ(wanted, found) or "", f"{wanted} -> {found}")

    def test_lines_that_are_the_same_on_the_page_are_printed_alike(self):
        outputs = Outputs()
        self.assertIsNone(outputs.differ("785 nodes\n", "790 nodes\n"))
        self.assertIsNone(outputs.differ("800 nodes\n785 nodes\n", "801 nodes\n790 nodes\n"))
        self.assertIn("790 nodes\n791 nodes", outputs.differ("785 nodes\n", "791 nodes\n"))

    def test_on_a_page(self):
        page = "```sh\necho 100 nodes\n```\n\n```text\n%d nodes\n```\n"
        self.assertEqual(run_page.run_page(PREFIX, page % 104), [])
        self.assertIn("expected\n125 nodes", run_page.run_page(PREFIX, page % 125)[0])


unittest.main()
