# SPDX-License-Identifier: BSD-3-Clause
"""The command that made a page, without the folders of the machine."""
import shlex
import sys


def shown_command(program, hidden, files=()):
    """Returns the command with words instead of the values of the options in `hidden`, and FILE...
    for the files."""
    shown, rest, files = [program], iter(sys.argv[1:]), {str(file) for file in files}
    for word in rest:
        option, equals, _ = word.partition("=")
        if option in hidden:
            shown += [option, hidden[option]]
            if not equals:
                next(rest, None)
        elif str(word) not in files:
            shown.append(shlex.quote(word))
    return " ".join(shown + (["FILE..."] if files else []))
